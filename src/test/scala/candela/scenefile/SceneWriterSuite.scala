package candela.scenefile

import candela.diagnostics.SceneError
import java.nio.file.Path

import candela.math.Transform
import org.scalatest.funsuite.AnyFunSuite

class SceneWriterSuite extends AnyFunSuite:

  private def parse(text: String, dialect: Option[Dialect] = None): SceneDescription =
    Parser.parseText("test.pbrt", text, Path.of("folder"), dialect)

  test("media keep their transform; the camera's and the lights' medium is the outer one"):
    val text = """Scale 2 2 2 MediumInterface "" "fog" Camera "perspective" WorldBegin
        |Translate 1 0 0 MakeNamedMedium "fog" "string type" "homogeneous" LightSource "point"
        |MediumInterface "" "" LightSource "point" """.stripMargin
    for (dialect, medium) <- List(Dialect.V3 -> "", Dialect.V4 -> "fog") do
      val scene = parse(text, Some(dialect))
      assert(scene.media.head.mediumToWorld == GraphicsState.constant(Transform.translate(1, 0, 0)))
      assert(scene.lights.map(_.medium) == Vector("fog", ""))
      assert(scene.cameraMedium == medium)

  test("a declaration knows in which color space its colours are"):
    val scene = parse("""ColorSpace "rec2020" WorldBegin LightSource "point" """)
    assert(scene.lights.head.light.colorSpace == "rec2020")

  test("a mixture of materials that are defined after it is told, where pbrt does not find them"):
    def warnings(text: String, d: Dialect) =
      parse(s"WorldBegin\n$text\nWorldEnd", Some(d)).warnings
    val red = "MakeNamedMaterial \"red\" \"string type\" \"matte\"\n"
    val mix = "\"string namedmaterial1\" \"red\" \"string namedmaterial2\" \"red\"\n"
    val written = s"Material \"mix\" $mix"
    val named = s"MakeNamedMaterial \"both\" \"string type\" \"mix\" $mix"
    val old = Set(Dialect.V2, Dialect.V3)
    for (text, dialects) <- Seq(written -> Set(Dialect.V3), named -> old) do
      for d <- Seq(Dialect.V2, Dialect.V3) do
        val late = warnings(text + red, d)
        assert(late.size == (if dialects(d) then 2 else 0), s"$d $late")
        assert(late.forall(_.message.startsWith("material `red` is defined only later, at ")))
        assert(late.forall(_.pos.map(_.line).contains(2)))
        assert(warnings(red + text, d).isEmpty)
    val v4 = "MakeNamedMaterial \"both\" \"string type\" \"mix\" \"string materials\" " +
      "[\"red\" \"red\"]\n" + red.replace("matte", "diffuse")
    assert(parse(s"WorldBegin\n$v4", Some(Dialect.V4)).warnings.isEmpty)

  test("a medium or texture that is defined again and again is each time the new one"):
    def many(line: Int => String) =
      (1 to 2000).map(line).mkString("WorldBegin\n", "\n", "\nWorldEnd")
    val media = many: i =>
      s"MakeNamedMedium \"m${i % 3}\" \"string type\" \"homogeneous\" \"float scale\" $i"
    val found = parse(media, Some(Dialect.V3)).media
    assert(found.map(_.name) == Vector("m0", "m1", "m2"))
    assert(found.map(_.medium.params.head.floats(0)) == Vector(1998f, 1999f, 2000f))
    val kinds = Vector("float", "spectrum")
    val textures =
      parse(many(i => s"Texture \"t\" \"${kinds(i % 2)}\" \"constant\""), Some(Dialect.V3)).textures
    assert(textures.size > 2000 && textures.map(t =>
      (t.name, t.valueType)
    ).distinct == textures.map(t => (t.name, t.valueType)))

  test("more defaults than there are parameters are an error"):
    val defaults = (1 to 2000).map(i => s"Attribute \"shape\" \"float a$i\" 1").mkString("\n")
    val problems = intercept[SceneError](parse(s"WorldBegin\n$defaults", Some(Dialect.V4))).problems
    assert(problems.head.message == "more than 1000 defaults of \"shape\"")

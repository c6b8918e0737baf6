package candela.build

import candela.diagnostics.{Problem, Severity}
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Parameters of another type than pbrt looks for. */
final class ValueTypesSuite extends AnyFunSuite:
  private def scene(light: String, material: String, camera: String = "\"perspective\"") =
    s"""Film "image" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "halton" "integer pixelsamples" 4
       |Camera $camera
       |WorldBegin
       |LightSource $light
       |Material $material
       |Translate 0 0 2
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point P" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]
       |WorldEnd
       |""".stripMargin

  private val grey = "\"matte\" \"rgb Kd\" [.4 .4 .4]"
  private val plainLight = "\"infinite\" \"rgb L\" [2 2 2]"
  private val old = Seq(Dialect.V2, Dialect.V3)

  /** The warning about a wrong parameter, which changes nothing. */
  private def ignored(d: Dialect, wrong: String, plain: String): Problem =
    val found = SceneTexts.problems(wrong, d).filter(_.message.contains("must be of type"))
    assert(found.size == 1 && found.head.severity == Severity.Warning, found)
    assert(SceneTexts.mean(wrong, d) == SceneTexts.mean(plain, d))
    found.head

  test("a number is no scale of a light in v2 and v3", Slow):
    for
      d <- old
      light <- Seq(
        plainLight,
        "\"distant\" \"rgb L\" [2 2 2]",
        "\"point\" \"rgb I\" [2 2 2]",
        "\"spot\" \"rgb I\" [2 2 2]",
        "\"projection\" \"rgb I\" [2 2 2]",
        "\"goniometric\" \"rgb I\" [2 2 2]"
      )
    do
      val p = ignored(d, scene(s"$light \"float scale\" 3", grey), scene(light, grey))
      assert(p.help.contains("write \"rgb scale\" [ 3 3 3 ]"), p)
      assert(p.pos.map(_.line).contains(5))

  test("a number is no colour of a material in v2 and v3"):
    for d <- old do
      val wrong = scene(plainLight, "\"matte\" \"float Kd\" .8")
      val p = ignored(d, wrong, scene(plainLight, "\"matte\""))
      assert(p.message == "`Kd` of \"matte\" must be of type spectrum texture, found float; " +
        "it is ignored, as pbrt does")
      assert(p.help.contains("write \"rgb Kd\" [ 0.8 0.8 0.8 ]"))

  test("an integer is no field of view, and v4 says so with an error"):
    val wrong = scene(plainLight, grey, "\"perspective\" \"integer fov\" 20")
    for d <- old do
      val p = ignored(d, wrong, scene(plainLight, grey))
      assert(p.help.contains("write \"float fov\" 20"))
    val found = SceneTexts.problems(wrong, Dialect.V4)
    assert(found.exists(p => p.severity == Severity.Error && p.message.startsWith("`fov` of")))

  test("vectors are no points, and colours no numbers"):
    for d <- old do
      ignored(d, scene("\"point\" \"vector from\" [0 0 1]", grey), scene("\"point\"", grey)): Unit
      ignored(
        d,
        scene(plainLight, grey + " \"rgb sigma\" [20 20 20]"),
        scene(plainLight, grey)
      )

  test("of several numbers for a texture, v2 and v3 take the first"):
    for d <- old do
      val many = scene(plainLight, grey + " \"float sigma\" [20 30]")
      val one = scene(plainLight, grey + " \"float sigma\" 20")
      assert(SceneTexts.mean(many, d) == SceneTexts.mean(one, d))

  test("what each pbrt reads under two types, it reads here"):
    val curve = "Shape \"curve\" \"integer splitdepth\" 2 " +
      "\"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"float width\" .1"
    val eta = "Material \"dielectric\" \"float eta\" 1.3\nShape \"sphere\""
    for (body, d) <- Seq(curve -> Dialect.V3, curve -> Dialect.V4, eta -> Dialect.V4) do
      val text = s"WorldBegin\nLightSource \"infinite\"\n$body\n"
      assert(SceneTexts.problems(text, d).isEmpty)

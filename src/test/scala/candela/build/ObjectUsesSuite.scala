package candela.build

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

class ObjectUsesSuite extends AnyFunSuite:

  private val ball = """Shape "sphere""""

  private def scene(objectBody: String, instances: String): String =
    s"""WorldBegin
       |LightSource "distant"
       |ObjectBegin "thing"
       |$objectBody
       |ObjectEnd
       |$instances
       |WorldEnd
       |""".stripMargin

  private def features(text: String): Map[String, String] =
    SceneTexts.plan(text, Dialect.V3).features.toMap

  private val twice = "ObjectInstance \"thing\"\nTranslate 3 0 0\nObjectInstance \"thing\"\n"

  test("an object that stands once is part of the world"):
    val found = features(scene(ball, "Translate 1 0 0 ObjectInstance \"thing\""))
    assert(found("instances") == "none" && found("other shapes") == "1")

  test("an object that stands twice is instanced"):
    val found = features(scene(ball, twice))
    assert(found("instances") == "2 of 1 objects with 0 triangles and 1 other shapes")
    assert(found("other shapes") == "0")

  test("an object that stands nowhere, or is empty, is nothing"):
    assert(features(scene(ball, ""))("instances") == "none")
    assert(features(scene("", twice))("instances") == "none")

  test("what no instance can do, a perspective map, makes copies"):
    val view = "ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 .1  0 0 0 1]\n"
    val mesh = """Shape "trianglemesh" "point P" [0 0 0 1 0 0 0 1 1] "integer indices" [0 1 2]"""
    val found = features(scene(mesh, view + twice))
    assert(found("instances") == "none" && found("triangles") == "2")

  test("an emitting shape in an object is dark in v4, with a warning at its light"):
    val text = scene("AreaLightSource \"diffuse\"\n" + ball, twice).replace("WorldEnd", "")
    val found = SceneTexts.problems(text, Dialect.V4)
    assert(found.count(_.message.contains("emission is ignored")) == 1)
    assert(found.head.pos.map(_.line).contains(4))
    assert(SceneTexts.plan(text, Dialect.V4).features.toMap.apply("lights").startsWith("one light"))

  private val square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "

  /** An emitter of a third of the image, as an object; with a wall behind it if `lit`. */
  private def emitter(dialect: Dialect, method: String, lit: Boolean, copies: Int, body: String) =
    val integrator = if dialect == Dialect.V2 then "SurfaceIntegrator" else "Integrator"
    val wall = if lit then
      "LightSource \"point\" \"point from\" [0 0 -3] \"color I\" [1 1 1]\n" +
        s"Material \"matte\" \"color Kd\" [.5 .5 .5]\n$square [-9 -9 1 9 -9 1 9 9 1 -9 9 1]"
    else ""
    s"""Film "image" "integer xresolution" 32 "integer yresolution" 24
       |Sampler "random" "integer pixelsamples" 16
       |$integrator "$method" "integer maxdepth" 5
       |LookAt 0 0 -5  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [-2 2 -1.5 1.5]
       |WorldBegin
       |ObjectBegin "o"
       |AreaLightSource "diffuse" "color L" [1 1 1]
       |$body
       |ObjectEnd
       |${"ObjectInstance \"o\"\nTranslate 40 0 0\n" * copies}
       |Identity
       |$wall
       |WorldEnd
       |""".stripMargin

  private val panel = s"ReverseOrientation\n$square [-1 -1 0 1 -1 0 1 1 0 -1 1 0]"

  test("v2 and v3 show area lights of objects"):
    for
      (d, method) <- Seq(
        Dialect.V2 -> "path",
        Dialect.V2 -> "directlighting",
        Dialect.V3 -> "path",
        Dialect.V3 -> "volpath",
        Dialect.V3 -> "directlighting",
        Dialect.V3 -> "whitted",
        Dialect.V3 -> "bdpt"
      )
      copies <- Seq(1, 2)
    do
      val text = emitter(d, method, lit = false, copies, panel)
      // A third of the pixels, as in pbrt; edges run between pixels
      assert(Math.abs(SceneTexts.mean(text, d).average - 1f / 3) < 1e-4f, s"$d $method $copies")
      val told = SceneTexts.problems(text, d).filter(_.message.contains("light nothing"))
      assert(told.size == 1 && told.head.pos.map(_.line).contains(8))

  test("area lights of objects light nothing in v2 and v3"):
    for (d, method) <- Seq(Dialect.V3 -> "path", Dialect.V3 -> "volpath", Dialect.V2 -> "path") do
      def mean(emitters: String) =
        SceneTexts.mean(emitter(d, method, lit = true, 1, emitters), d).average
      val small = s"ReverseOrientation\n$square [-1 -1 0 1 -1 0 1 1 0 -1 1 0]"
      val seen = mean(small)
      val dark = mean("AreaLightSource \"\"\n" + small)
      // The emitter adds itself, and nothing elsewhere; the noise of 12288 samples is below 0.001
      assert(Math.abs(seen - dark - 1f / 3) < 4e-3f, s"$d $method: $seen and $dark")

  test("an instance of nothing is an error, and says what was meant"):
    val found = SceneTexts.problems(scene(ball, "ObjectInstance \"thingy\""), Dialect.V3)
    assert(found.exists(p => p.message.contains("`thingy`") && p.help.exists(_.contains("thing"))))

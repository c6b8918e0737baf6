package candela.scenefile

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
      assert(scene.media.head.mediumToWorld == GraphicsState.still(Transform.translate(1, 0, 0)))
      assert(scene.lights.map(_.medium) == Vector("fog", ""))
      assert(scene.cameraMedium == medium)

  test("a declaration knows in which color space its colours are"):
    val scene = parse("""ColorSpace "rec2020" WorldBegin LightSource "point" """)
    assert(scene.lights.head.light.colorSpace == "rec2020")

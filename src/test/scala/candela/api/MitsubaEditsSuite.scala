package candela.api

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Path

import scala.util.Using

/** Edits of scenes of Mitsuba. */
class MitsubaEditsSuite extends AnyFunSuite:

  private def scene(alpha: String): Scene =
    Candela.parse(
      s"""<scene version="3.0.0"><integrator type="path"/>
         |  <sensor type="perspective">
         |    <transform name="to_world"><lookat origin="0,0,-4" target="0,0,0" up="0,1,0"/>
         |    </transform>
         |    <film type="hdrfilm"><integer name="width" value="16"/>
         |      <integer name="height" value="12"/></film>
         |  </sensor>
         |  <emitter type="directional"/>
         |  <shape type="sphere"><bsdf type="roughconductor"><float name="alpha" value="$alpha"/>
         |  </bsdf></shape>
         |</scene>""".stripMargin,
      Path.of("scene.xml"),
      ReadSettings()
    )

  private def brightness(scene: Scene): Double =
    Using.resource(scene.prepare(RenderSettings(), 2))(_.render(2)).image.mean("R")

  test("a roughness replaces that of both axes"):
    val rough = Parameters().number("roughness", 0.4)
    val edited = scene("0.1").edit().changeMaterialOf(0, rough).scene()
    assert(brightness(edited) == brightness(scene("0.4")))
    assert(brightness(edited) != brightness(scene("0.1")))

  test("new statements are pbrt-v4's, as those of scenes made in code"):
    val edited = scene("0.1").edit().material("roughplastic", Parameters())
      .shape("sphere", Parameters()).scene()
    val problem = edited.check(RenderSettings()).get(0)
    assert(problem.message == "unknown material \"roughplastic\"", problem)
    assert(problem.help.get.contains("plastic"))

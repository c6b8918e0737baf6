package candela.integrators

import candela.build.SceneBuilder
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

/** Lights of models that the camera does not see, and that cast no shadow. */
class LightsInViewSuite extends AnyFunSuite:
  private def seen(integrator: String, world: String): Double =
    val text =
      s"""LookAt 0 -6 3  0 0 0  0 0 1
         |Camera "perspective" "float fov" 8
         |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
         |Sampler "halton" "integer pixelsamples" 64
         |Integrator "$integrator"
         |WorldBegin
         |$world""".stripMargin
    val scene = SceneTexts.parse(text, Dialect.V4).copy(dialect = Dialect.Gltf)
    val (plan, _) = SceneBuilder.build(scene, RenderSettings())
    val data = Renderer.render(plan, threads = 1).image(plan.development).data
    data.map(_.toDouble).sum / data.length

  private def lamp(inView: Boolean): String =
    s"""AttributeBegin
       |Material "interface"
       |AreaLightSource "diffuse" "rgb L" [1 1 1] "bool inview" $inView
       |Shape "sphere" "float radius" 2
       |AttributeEnd
       |""".stripMargin

  /** Behind the lamp, towards the camera. */
  private val mirror =
    """Material "conductor" "float roughness" 0 "rgb reflectance" [1 1 1]
      |Rotate 63.435 1 0 0
      |Translate 0 0 -4
      |Shape "disk" "float radius" 20
      |""".stripMargin

  for integrator <- Vector("path", "volpath") do
    test(s"$integrator: a light that is not in view is seen in a mirror only"):
      assert(seen(integrator, lamp(inView = true)) > 0.9)
      assert(seen(integrator, lamp(inView = false)) == 0.0)
      assert(seen(integrator, lamp(inView = false) + mirror) > 0.9)

    test(s"$integrator: a light casts no shadow"):
      val ground = """Material "diffuse" "rgb reflectance" [1 1 1]
        Shape "disk" "float radius" 20 "float height" -2.5
        """
      val sky = """LightSource "infinite" "rgb L" [1 1 1]
        """
      val dim = lamp(inView = false).replace("[1 1 1]", "[1e-6 1e-6 1e-6]")
      val (open, beneath) = (seen(integrator, sky + ground), seen(integrator, sky + dim + ground))
      // A white furnace; the sphere would hide half of the sky
      assert(Math.abs(open - 1) < 0.02 && Math.abs(beneath - open) < 0.02)

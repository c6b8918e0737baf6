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
      val sun = """LightSource "distant" "rgb L" [3.14159 3.14159 3.14159]
          "point3 from" [0 -2 1] "point3 to" [0 0 0]
        """
      val dim = lamp(inView = false).replace("[1 1 1]", "[1e-6 1e-6 1e-6]")
      val (open, beneath) = (seen(integrator, sun + ground), seen(integrator, sun + dim + ground))
      // A white plane that the light meets at this cosine; the sphere would hide all of it
      val cosine = 1 / Math.sqrt(5)
      assert(Math.abs(open - cosine) < 0.01 && Math.abs(beneath - open) < 0.01)

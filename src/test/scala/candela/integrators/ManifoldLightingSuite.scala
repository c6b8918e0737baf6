package candela.integrators

import candela.image.Image
import candela.render.{Renderer, RenderPlan}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Manifold walks find the light of a point, or of a tiny ball, that paths find of a larger ball in
  * its place.
  */
final class ManifoldLightingSuite extends AnyFunSuite:
  import ManifoldLightingSuite.*

  private def plan(text: String, mode: CausticsMode, spp: Int): RenderPlan =
    val settings = RenderSettings(Some(spp), color = ColorMode.Rgb, caustics = Some(mode))
    SceneTexts.plan(text, Dialect.V4, settings)

  private def image(text: String, mode: CausticsMode, spp: Int): Image =
    image(plan(text, mode, spp))

  private def image(plan: RenderPlan): Image =
    Renderer.render(plan, threads = 2).image(plan.development)

  for
    (what, surface) <- Seq(
      "calm water" -> """Shape "disk" "float height" .5 "float radius" 9""",
      "waves" -> waves(24),
      // Two surfaces: light comes down through both, and is seen through both
      "a pane of glass" -> """Shape "disk" "float height" .5 "float radius" 9
        ReverseOrientation Shape "disk" "float height" .3 "float radius" 9"""
    )
  do
    test(s"walks find of a tiny light what paths find of a large one, on a wall, too: $what", Slow):
      val walked = plan(scene(s"$wall $surface", ball(0.0005)), CausticsMode.Auto, 64)
      assert(walks(walked))
      val found = image(walked)
      val expected = image(scene(s"$wall $surface", ball(Radius)), CausticsMode.Off, 256)
      BlockMeans.assertEqual(found, expected, allowance = 0.03)

    test(s"of two partitions of light, walks and paths, both have the same mean: $what"):
      val expected = image(scene(surface, ball(Radius)), CausticsMode.Off, 128)
      val found = image(scene(surface, point), CausticsMode.On, 32)
      assert(image(scene(surface, point), CausticsMode.Off, 1).data.sum < 0.2 * found.data.sum)
      // The ball's centre is as far as its parts but for the square of its size, 1 %
      BlockMeans.assertEqual(found, expected, allowance = 0.03)

  test("where rays pass surfaces by chance, there are no walks, as trials would count that", Slow):
    val water = """Shape "disk" "float height" .5 "float radius" 9"""
    def walked(alpha: String) =
      walks(plan(scene(water + alpha, ball(0.0005)), CausticsMode.Auto, 64))
    assert(walked("") && walked(""" "float alpha" 1""") && !walked(""" "float alpha" .5"""))

  private def walks(plan: RenderPlan): Boolean =
    plan.features.toMap.apply("caustics").contains("manifold walks find")

private object ManifoldLightingSuite:
  private val Radius = 0.25

  private val point = """LightSource "point" "rgb I" [9 9 9] "point3 from" [1.6 -.6 2.4]"""

  /** Sends as much light as the point. */
  private def ball(radius: Double): String =
    val radiance = 9 / (Math.PI * radius * radius)
    s"""AttributeBegin Translate 1.6 -.6 2.4
        AreaLightSource "diffuse" "rgb L" [$radiance $radiance $radiance]
        Shape "sphere" "float radius" $radius AttributeEnd"""

  /** Beneath the surface: it is lit by the floor, too. */
  private val wall = """AttributeBegin Translate 0 1.5 0 Rotate 90 1 0 0
        Material "diffuse" "rgb reflectance" [.8 .8 .8]
        Shape "disk" "float radius" .48 AttributeEnd"""

  /** A floor beneath the surface. The mirror image of the emitter is out of view. */
  private def scene(surface: String, emitter: String) =
    s"""LookAt 0 -1.5 3.2  0 0 0  0 0 1
       |Camera "perspective" "float fov" 18
       |Film "rgb" "integer xresolution" 32 "integer yresolution" 16
       |PixelFilter "box"
       |Sampler "independent"
       |Integrator "path" "integer maxdepth" 5
       |WorldBegin
       |$emitter
       |Material "diffuse" "rgb reflectance" [.6 .6 .6]
       |Shape "disk" "float radius" 9
       |Material "dielectric" "float eta" 1.33
       |$surface
       |""".stripMargin

  private def waves(n: Int): String =
    val points = for j <- 0 to n; i <- 0 to n yield (4.0 * i / n - 2, 4.0 * j / n - 2)
    val p = points.map((x, y) => s"$x $y ${0.5 + 0.02 * Math.sin(3 * x + y)}").mkString(" ")
    val slope = (x: Double, y: Double) => -0.02 * Math.cos(3 * x + y)
    val normals = points.map((x, y) => s"${3 * slope(x, y)} ${slope(x, y)} 1").mkString(" ")
    val faces =
      for j <- 0 until n; i <- 0 until n; a = j * (n + 1) + i
      yield s"$a ${a + 1} ${a + n + 2} $a ${a + n + 2} ${a + n + 1}"
    s"""Shape "trianglemesh" "point3 P" [$p] "normal N" [$normals]
        "integer indices" [${faces.mkString(" ")}]"""

package candela.build.integrators

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.film.PixelBounds
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.{RenderRegion, RenderSettings}
import candela.testing.SceneTexts

/** What integrators can be told beside how far to follow light. */
final class IntegratorOptionsSuite extends AnyFunSuite:

  private def window(integrator: String, film: String = ""): String =
    s"""Film "image" "integer xresolution" 80 "integer yresolution" 60 $film
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite"
       |Shape "sphere"
       |""".stripMargin

  for name <- Seq("path", "volpath", "bdpt", "directlighting", "whitted", "ambientocclusion") do
    test(s"`pixelbounds` of \"$name\" is the part that is rendered"):
      val text = window(s"\"$name\" \"integer pixelbounds\" [3 50 7 59]")
      assert(SceneTexts.plan(text).crop == PixelBounds(3, 7, 50, 59))
      assert(SceneTexts.problems(text).isEmpty)

  test("`pixelbounds` and the film's crop window hold both, and the command line's goes first"):
    val both = window(
      "\"path\" \"integer pixelbounds\" [-5 50 7 1000]",
      "\"float cropwindow\" [.5 1 0 .5]"
    )
    assert(SceneTexts.plan(both).crop == PixelBounds(40, 7, 50, 30))
    val asked = RenderSettings(region = RenderRegion.Window(0f, 0.25f, 0f, 1f))
    assert(SceneTexts.plan(both, options = asked).crop == PixelBounds(0, 0, 20, 60))

  test("v2's igi and irradiancecache are replaced by paths with as many bounces, probes by path"):
    def depth(integrator: String) =
      val text = window(integrator).replace("Integrator", "SurfaceIntegrator") + "WorldEnd"
      val said = SceneTexts.plan(text, Dialect.V2).features.map(_._2).mkString("\n")
      "up to (\\d+) scattering events".r.findFirstMatchIn(said).map(_.group(1).toInt)
    assert(depth("\"irradiancecache\"").contains(4))
    assert(depth("\"irradiancecache\" \"integer maxindirectdepth\" 7").contains(8))
    assert(depth("\"igi\" \"integer maxdepth\" 2").exists(_ >= 1000))
    assert(depth("\"useprobes\"").contains(6) && depth("\"path\"").contains(6))

  test("the part is the same of a smaller image"):
    val text = window("\"path\" \"integer pixelbounds\" [40 80 0 30]")
    val plan = SceneTexts.plan(text, options = RenderSettings(quick = true))
    assert(plan.crop == PixelBounds(10, 0, 20, 8))

  test("`pixelbounds` of no pixel or of no four numbers are errors"):
    def errors(bounds: String) =
      SceneTexts.problems(window(s"\"path\" \"integer pixelbounds\" $bounds")).map(_.message)
    assert(errors("[90 95 0 10]").exists(_.contains("no pixel")))
    assert(errors("[1 2 3]").exists(_.contains("must be x0 x1 y0 y1, found 3 numbers")))

  // A floor that a mirror lights: the light is a point, so that no path finds it by the mirror
  private def mirrored(integrator: String, mirror: String, eye: String): String =
    s"""LookAt $eye  0 1 0
       |Camera "orthographic" "float screenwindow" [-.2 .2 -.2 .2]
       |Film "rgb" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "independent" "integer pixelsamples" 500
       |Integrator $integrator
       |WorldBegin
       |LightSource "point" "point3 from" [-2 0 .5]
       |MakeNamedMaterial "one" "string type" "conductor" "rgb reflectance" [.9 .9 .9]
       |  "float roughness" 0
       |AttributeBegin
       |Material "diffuse" "rgb reflectance" [0 0 0]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point3 P" [-1 -9 0  -1 9 0  -1 9 1  -1 -9 1]
       |AttributeEnd
       |AttributeBegin
       |$mirror
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "point3 P" [-9 -9 3  9 -9 3  9 9 3  -9 9 3]
       |AttributeEnd
       |Material "diffuse" "rgb reflectance" [.5 .5 .5]
       |Shape "disk" "float radius" 1
       |""".stripMargin

  private val down = "0 0 2  0 0 0"
  private val conductor =
    """Material "conductor" "rgb reflectance" [.9 .9 .9] "float roughness" 0"""
  private val named = """NamedMaterial "one""""

  for
    integrator <- Seq("\"path\"", "\"volpath\"")
    mirror <- Seq(conductor, named, """Material "coatedconductor"""")
  do
    test(s"$integrator finds by widened scattering what it never does by a mirror: $mirror"):
      def seen(more: String) =
        SceneTexts.mean(mirrored(s"$integrator $more", mirror, down), Dialect.V4)
      assert(seen("") == Rgb.Black)
      val found = seen("\"bool regularize\" true").g
      // What the mirror image of the light would bring: I / π · ρ · cos / r², smeared
      val expected = 0.5 / Math.PI * 0.9 * 5.5 / Math.pow(4 + 5.5 * 5.5, 1.5)
      val part = found / expected
      assert(part > 0.4 && part < 1.6, s"$part of what a mirror would bring")

  test("bidirectional paths add what is widened to what is sharp, as pbrt-v4's do"):
    // Paths from the light find the mirror sharp, those from the camera find it widened: neither
    // knows of the other. pbrt-v4 has 1.5 times the light here
    def seen(more: String) =
      SceneTexts.mean(mirrored(s"\"bdpt\" $more", conductor, down), Dialect.V4).g
    val sharp = seen("")
    val both = seen("\"bool regularize\" true") / sharp
    assert(sharp > 0f && both > 1.3f && both < 2.5f, s"$both times the light")

  test("what a path meets first is not widened"):
    // Up into the mirror, which shows the floor around the light's shadow
    def image(more: String) =
      val text = mirrored(s"\"path\" \"integer maxdepth\" 2 $more", conductor, "-.5 0 1  -1 0 2.9")
      val plan = SceneTexts.plan(text.replace("radius\" 1", "radius\" 9"), Dialect.V4)
      Renderer.render(plan, 1).image(plan.development).data.toVector
    assert(image("") == image("\"bool regularize\" true") && image("").exists(_ > 0f))

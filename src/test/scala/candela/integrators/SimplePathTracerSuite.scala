package candela.integrators

import org.scalatest.funsuite.AnyFunSuite

import candela.aov.Layer
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

/** pbrt-v4's integrators for teaching: `simplepath`, `randomwalk`, `simplevolpath`, `lightpath`. */
final class SimplePathTracerSuite extends AnyFunSuite:

  private def mean(text: String): Float = SceneTexts.mean(text, Dialect.V4).g

  private def view(integrator: String, spp: Int): String =
    s"""Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "halton" "integer pixelsamples" $spp
       |Integrator $integrator
       |WorldBegin
       |""".stripMargin

  /** From inside, a sphere of albedo 0.7 that emits radiance 1 inwards. */
  private def oven(integrator: String): String =
    s"""Camera "perspective"
       |${view(integrator, 256)}
       |Material "diffuse" "rgb reflectance" [.7 .7 .7]
       |AreaLightSource "diffuse" "rgb L" [1 1 1]
       |ReverseOrientation
       |Shape "sphere"
       |""".stripMargin

  private val unsampled = "\"simplepath\" \"bool samplelights\" false"

  for
    integrator <- Seq(
      "\"simplepath\"",
      unsampled,
      "\"simplepath\" \"bool samplebsdf\" false",
      s"$unsampled \"bool samplebsdf\" false",
      "\"randomwalk\"",
      "\"simplevolpath\""
    )
    depth <- Seq(0, 1, 3)
  do
    test(s"inside a glowing sphere all light of up to $depth bounces is seen: $integrator"):
      val seen = mean(oven(s"$integrator \"integer maxdepth\" $depth"))
      val expected = (0 to depth).map(Math.pow(0.7, _)).sum.toFloat
      // A uniform direction has the weight 2 cos or 4 cos, of deviation 0.6 or 1.3; of three
      // bounces and 16,384 paths, some 2 %, and less as Halton's points are even
      assert(Math.abs(seen - expected) < 0.03f * expected, s"$seen, expected $expected")

  /** A disk that fills the view, under a light. */
  private def disk(integrator: String, light: String, material: String): String =
    s"""LookAt 0 -6 3  0 0 0  0 0 1
       |Camera "perspective" "float fov" 10
       |${view(integrator, 256)}
       |$light
       |$material
       |Shape "disk" "float radius" 4
       |""".stripMargin

  private val matte = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]"
  private val point = "LightSource \"point\" \"point3 from\" [0 0 3]"
  private val sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]"

  test("a point light shines for paths that sample lights, and for no others, which is said"):
    val sampled = disk("\"simplepath\"", point, matte)
    assert(mean(sampled) > 0.01f && SceneTexts.problems(sampled, Dialect.V4).isEmpty)
    for integrator <- Seq(unsampled, "\"randomwalk\"", "\"simplevolpath\"") do
      val dark = disk(integrator, point, matte)
      assert(mean(dark) == 0f, integrator)
      val said = SceneTexts.problems(dark, Dialect.V4).map(_.message)
      assert(said.exists(_.contains("does not sample lights")), integrator)

  test("a mirror shows the sky to directions of the BSDF, and is black to uniform ones"):
    val mirror = "Material \"conductor\" \"rgb reflectance\" [.5 .5 .5]"
    assert(Math.abs(mean(disk("\"simplepath\"", sky, mirror)) - 0.5f) < 0.05f) // Fresnel
    assert(mean(disk("\"simplepath\" \"bool samplebsdf\" false", sky, mirror)) == 0f)
    assert(mean(disk("\"randomwalk\"", sky, mirror)) == 0f)

  test("a random walk ends at an interface, and simple paths pass it"):
    val pane = "AttributeBegin\nMaterial \"interface\"\nTranslate 0 0 .5\n" +
      "Shape \"disk\" \"float radius\" 5\nAttributeEnd\n"
    def behind(integrator: String) = mean(disk(integrator, s"$sky\n$pane", matte))
    assert(behind("\"randomwalk\"") == 0f)
    for integrator <- Seq("\"simplepath\"", unsampled) do
      assert(Math.abs(behind(integrator) - 0.5f) < 0.03f, integrator) // noise of light sampling

  test("both sides of a translucent sheet are sampled"):
    val sheet = "Material \"diffusetransmission\" \"rgb reflectance\" [.2 .2 .2] " +
      "\"rgb transmittance\" [.3 .3 .3]"
    for integrator <- Seq("\"randomwalk\"", "\"simplepath\" \"bool samplebsdf\" false") do
      assert(Math.abs(mean(disk(integrator, sky, sheet)) - 0.5f) < 0.02f, integrator) // noise

  /** Fog around an emitter. */
  private def fog(integrator: String): String =
    s"""LookAt 0 -4 0  0 0 0  0 0 1
       |Camera "perspective" "float fov" 30
       |${view(s"$integrator \"integer maxdepth\" 3", 1024)}
       |MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.8 .8 .8]
       |  "rgb sigma_a" [.3 .3 .3] "rgb Le" [.2 .2 .2]
       |LightSource "infinite" "rgb L" [.5 .5 .5]
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [2 2 2]
       |Material "diffuse" "rgb reflectance" [0 0 0]
       |Shape "sphere" "float radius" .3
       |AttributeEnd
       |Material "interface"
       |MediumInterface "fog" ""
       |Shape "sphere"
       |""".stripMargin

  test("in fog, simple paths see what paths see that sample lights, and what ends them glows"):
    val simple = mean(fog("\"simplevolpath\""))
    // What absorbs a path shines after its last event, too, which "volpath" leaves out: scattered
    // three times, a path has some 0.2 left, of which a third meets an emission of 0.2
    val full = mean(fog("\"volpath\""))
    assert(simple >= full * 0.99f && simple < full * 1.03f, s"$simple, volpath $full")

  /** A floor and a wall that an emitter and a spot light, without a sky. */
  private def corner(integrator: String, spp: Int): String =
    s"""LookAt 0 -6 3  0 0 .8  0 0 1
       |Camera "perspective" "float fov" 36
       |${view(s"$integrator \"integer maxdepth\" 3", spp)}
       |LightSource "spot" "point3 from" [-2 -2 4] "point3 to" [-1 0 .6] "rgb I" [14 12 10]
       |$matte
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  3 2 4 3 4 5]
       |  "point3 P" [-3 -3 0  3 -3 0  3 2 0  -3 2 0  3 2 2.4  -3 2 2.4]
       |AreaLightSource "diffuse" "rgb L" [5 5 5]
       |Translate 1.6 .8 1.9
       |Rotate 110 1 0 0
       |Shape "disk" "float radius" .5
       |""".stripMargin

  test("light tracing alone sees matte surfaces and emitters as path tracing does"):
    val light = mean(corner("\"lightpath\"", 2048))
    val path = mean(corner("\"path\"", 512))
    // 131,072 light paths that deviate by twice the mean, 32,768 paths by less than it: 0.5 % each
    assert(path > 0.1f && Math.abs(light - path) < 0.01f * path, s"$light, path $path")

  test("light tracing shows neither the sky nor what is behind glass, but what a glass throws"):
    assert(mean(disk("\"lightpath\"", sky, "Material \"conductor\"")) == 0f)
    val lens = "AttributeBegin\nMaterial \"dielectric\"\nTranslate 0 0 .8\n" +
      "Shape \"sphere\" \"float radius\" .4\nAttributeEnd\n"
    val lit = mean(disk("\"lightpath\"", s"$point\n$lens", matte))
    assert(lit > 0.01f, lit)

  test("layers of light divide the light of simple paths, too"):
    for integrator <- Seq("\"simplepath\"", unsampled, "\"simplevolpath\"") do
      val text = corner(integrator, 64)
      val options = RenderSettings(layers = Vector(Layer.Emission, Layer.Direct, Layer.Indirect))
      val plan = SceneTexts.plan(text, Dialect.V4, options)
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      val channels = image.channels
      def mean(c: Int) = image.data.indices.by(channels).map(i => image.data(i + c).toDouble).sum
      val (green, parts) = (mean(1), Seq(4, 7, 10).map(mean))
      assert(parts(1) > 0 && parts(2) > 0)
      assert(Math.abs(parts.sum - green) < 1e-5 * green, s"$parts, $green")

package candela.integrators

import candela.color.Rgb
import candela.image.Image
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class HeadlightSuite extends AnyFunSuite:
  private val asked = RenderSettings(preview = true, samples = Some(1))
  private val head = """LookAt 0 0 -4  0 0 0  0 1 0
    Camera "orthographic" "float screenwindow" [-1 1 -1 1]
    Sampler "independent"
    PixelFilter "box" """
  private def film(width: Int, height: Int) =
    s"""Film "rgb" "integer xresolution" $width "integer yresolution" $height "float iso" 5000"""

  private def render(text: String): Image =
    val plan = SceneTexts.plan(text, Dialect.V4, asked)
    Renderer.render(plan, threads = 1).image(plan.development)

  /** The colour in the middle. */
  private def color(world: String, integrator: String = "path"): Rgb =
    val image = render(s"$head ${film(5, 5)} Integrator \"$integrator\" WorldBegin $world")
    Rgb(image(2, 2, 0), image(2, 2, 1), image(2, 2, 2))

  // No noise; a sphere of radius 3 turns away within the pixel, by up to 0.4 % of 0.3
  private def assertClose(a: Rgb, b: Rgb): Unit =
    assert((a - b).largest < 2e-3f, s"$a, $b"): Unit

  private val paint = """Material "diffuse" "rgb reflectance" [.2 .4 .6]"""

  test("a surface that faces the camera shows its albedo; without lights, by any integrator"):
    for integrator <- Vector("path", "mlt", "sppm", "bdpt") do
      assertClose(color(s"$paint Shape \"disk\"", integrator), Rgb(.2f, .4f, .6f))

  test("a turned surface is darker"):
    // 0.2 + 0.8 · cos 60°
    val turned = color(s"Rotate 60 0 1 0 $paint Shape \"disk\" \"float radius\" 4")
    assertClose(turned, Rgb(.2f, .4f, .6f) * 0.6f)

  test("emitters are white, whatever their power; the background is dark, whatever is there"):
    val emitter = """AreaLightSource "diffuse" "rgb L" [900 5 5]"""
    // A disk's outside is towards +z
    assertClose(color(s"Rotate 180 0 1 0 $emitter $paint Shape \"disk\""), Rgb.White)
    assertClose(color("""LightSource "infinite" "rgb L" [90 90 90]"""), Rgb.gray(0.05f))

  test("the boundary of a medium shows where nothing is behind it"):
    val cloud = "Material \"interface\""
    val alone = color(s"$cloud Shape \"sphere\" \"float radius\" 3")
    assertClose(alone, Rgb.gray(0.05f + 0.3f))
    val before = color(s"$cloud Shape \"sphere\" Translate 0 0 2 $paint Shape \"disk\"")
    assertClose(before, Rgb(.2f, .4f, .6f))

  test("large images are reduced, small ones are not"):
    def size(width: Int, height: Int) =
      val text = s"$head ${film(width, height)} WorldBegin $paint Shape \"disk\""
      val plan = SceneTexts.plan(text, Dialect.V4, asked)
      (plan.width, plan.height)
    assert(size(400, 400) == (400, 400))
    assert(size(401, 400) == (400, 399))
    assert(size(3840, 2160) == (533, 300))

  test("films of layers and of wavelengths show a plain image"):
    for film <- Vector("gbuffer", "spectral") do
      val plan = SceneTexts.plan(s"$head Film \"$film\" WorldBegin", Dialect.V4, asked)
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      assert(image.channelNames == Image.RgbNames)

package candela.build.options

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.image.{Image, ImageFiles}
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** What pbrt-v4's options change in a picture; those of samples are tested by `PbrtHabitsSuite`. */
final class OptionStatementsSuite extends AnyFunSuite:

  /** A surface that fills the view, seen under a slant. */
  private def surface(light: String, material: String, spp: Int = 16): String =
    s"""LookAt 0 -6 3  0 0 0  0 0 1
       |Camera "perspective" "float fov" 10
       |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "independent" "integer pixelsamples" $spp
       |Integrator "path" "integer maxdepth" 1
       |WorldBegin
       |$light
       |$material
       |Shape "disk" "float radius" 40
       |""".stripMargin

  private def image(text: String, settings: RenderSettings, folder: Path = Path.of("")): Image =
    val description = SceneTexts.parse(text, Dialect.V4, folder)
    val plan = SceneBuilder.build(description, settings.copy(color = ColorMode.Rgb))._1
    Renderer.render(plan, threads = 1).image(plan.development)

  private def mean(image: Image): Rgb =
    val pixels = image.width * image.height
    def of(c: Int) = (0 until pixels).map(i => image.data(3 * i + c).toDouble).sum / pixels
    Rgb(of(0).toFloat, of(1).toFloat, of(2).toFloat)

  private val sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]"
  private val point = "LightSource \"point\" \"point3 from\" [0 0 3] \"rgb I\" [9 9 9]"
  private val sun =
    "LightSource \"distant\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 0] \"rgb L\" [3 3 3]"

  private val squares =
    s"""Texture "t" "spectrum" "checkerboard" "string mapping" "planar"
       |  "vector3 v1" [2 0 0] "vector3 v2" [0 2 0] "rgb tex1" [1 1 1] "rgb tex2" [0 0 0]
       |Material "diffuse" "texture reflectance" "t"""".stripMargin

  test("textures that are not filtered have their own colours only, at pixel centres"):
    def greys(settings: RenderSettings) =
      image(surface(sun, squares), settings).data.map(v => Math.round(v * 100)).distinct.length
    val filtered = RenderSettings(centers = true)
    assert(greys(filtered) > 10)
    assert(greys(filtered.copy(unfiltered = true)) == 2)

  test("image textures become their mean"):
    val folder = Files.createTempDirectory("candela-options")
    val file = folder.resolve("t.exr")
    try
      val texels = Array(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f, .2f, .2f, .2f)
      ImageFiles.write(file, Image(2, 2, Image.RgbNames, texels))
      val text = surface(
        sun,
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.exr\"\n" +
          "Material \"diffuse\" \"texture reflectance\" \"t\"",
        spp = 1
      )
      def values(settings: RenderSettings) =
        image(text, settings, folder).data.grouped(3).map(p => Math.round(p(0) * 50)).toSet.size
      assert(values(RenderSettings()) > 1)
      assert(values(RenderSettings(meanImages = true)) == 1)
    finally
      Files.delete(file)
      Files.delete(folder)

  test("a mirror turns into a diffuse surface of its own albedo"):
    val mirror = "Material \"conductor\" \"rgb reflectance\" [.7 .7 .7]"
    assert(mean(image(surface(point, mirror), RenderSettings())).g == 0f)
    assert(mean(image(surface(point, mirror), RenderSettings(diffuse = true))).g > 0.1f)
    // Of the sky, as much as a grey surface: of 1,024 samples, by light and by BSDF, 2 %
    val seen = mean(image(surface(sky, mirror), RenderSettings(diffuse = true))).g
    assert(Math.abs(seen - 0.7f) < 0.03f, seen) // and 0.01 of Fresnel's equations

  test("glass turns into a white surface, with what it reflects and what it transmits"):
    val glass = "Material \"dielectric\""
    val seen = mean(image(surface(sun, glass), RenderSettings(diffuse = true))).g
    val white = "Material \"diffuse\" \"rgb reflectance\" [1 1 1]"
    val expected = mean(image(surface(sun, white), RenderSettings())).g
    // Refracted radiance is compressed by the squared index, as in pbrt
    assert(seen > 0.4f * expected && seen < expected, s"$seen of $expected")

  test("with one set of wavelengths all samples take it, in spectral rendering"):
    def color(settings: RenderSettings, mode: ColorMode) =
      val options = settings.copy(color = mode)
      val plan = SceneTexts.plan(surface(sun, squares), Dialect.V4, options)
      plan.features.toMap.apply("color")
    val one = RenderSettings(oneColorSet = true)
    assert(color(one, ColorMode.Spectral).contains("always the same three"))
    assert(!color(RenderSettings(), ColorMode.Spectral).contains("always"))
    assert(!color(one, ColorMode.Rgb).contains("always"))
    val grey = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]"
    def lit(settings: RenderSettings) =
      val options = settings.copy(color = ColorMode.Spectral)
      val plan = SceneTexts.plan(surface(sun, grey), Dialect.V4, options)
      Renderer.render(plan, threads = 1).image(plan.development).data.map(v => Math.round(v * 1e4f))
    // Without their noise, but with another hue
    assert(lit(one).grouped(3).map(_.toVector).toSet.size == 1)
    assert(lit(RenderSettings()).grouped(3).map(_.toVector).toSet.size > 10)

  test("the user's settings go before the scene's, and seeds are combined"):
    val scene = RenderSettings(seed = 3, diffuse = true, edgeScale = Some(2f))
    val user = RenderSettings(seed = 5, centers = true, edgeScale = Some(4f))
    assert(user.overriding(scene) == scene.copy(seed = 6, centers = true, edgeScale = Some(4f)))
    assert(RenderSettings().overriding(scene) == scene)

  test("a scale of edges that is not above 0 is an error"):
    val found = SceneTexts.problems("Option \"displacementedgescale\" 0\nWorldBegin", Dialect.V4)
    assert(found.exists(_.message.contains("must be above 0")))

  test("an unknown space of ray tracing is an error, as in pbrt, though the space has no effect"):
    def found(space: String) =
      SceneTexts.problems(s"Option \"string rendercoordsys\" \"$space\"\nWorldBegin", Dialect.V4)
    assert(!found("world").exists(_.message.contains("rendercoordsys")))
    assert(found("eye").exists(_.message.contains("must be one of camera, cameraworld, world")))

package candela.build.film

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

import candela.build.{BuildOptions, SceneBuilder}
import candela.film.Layer
import candela.image.{Image, ImageFiles}
import candela.render.Renderer
import candela.scenefile.{Dialect, Parser}
import candela.testing.SceneTexts

/** Layers of whole scenes. */
final class FilmLayersSuite extends AnyFunSuite:
  private val view = """LookAt 0 0 -4  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Sampler "independent" "integer pixelsamples" 4"""
  private def film(kind: String) =
    s"""Film "$kind" "integer xresolution" 20 "integer yresolution" 20"""
  private val world = """WorldBegin
    LightSource "infinite" "rgb L" [.5 .5 .5]
    Material "diffuse" "rgb reflectance" [.2 .4 .6]
    Shape "disk" "float radius" 1 """

  private def render(text: String, options: BuildOptions = BuildOptions()): Image =
    val plan = SceneTexts.plan(text, Dialect.V4, options)
    Renderer.render(plan, threads = 2).image(plan.development)

  private def pixel(image: Image, x: Int, y: Int)(names: String*): Seq[Float] =
    names.map(n => image(x, y, image.channelNames.indexOf(n)))

  private def assertClose(found: Seq[Float], expected: Float*): Unit =
    assert(found.lazyZip(expected).forall((a, b) => Math.abs(a - b) < 2e-3f), s"$found"): Unit

  test("the film gbuffer has the disk's place, normal, albedo and parameters"):
    val image = render(s"$view\n${film("gbuffer")}\n$world")
    assertClose(pixel(image, 10, 10)("P.Z", "N.X", "N.Y", "N.Z", "Ns.Z"), 4, 0, 0, -1, -1)
    assertClose(pixel(image, 10, 10)("Albedo.R", "Albedo.G", "Albedo.B"), .2f, .4f, .6f)
    assertClose(pixel(image, 0, 0)("P.Z", "N.Z", "Albedo.R", "Variance.R"), 0, 0, 0, 0)
    // v of a disk falls from 1 in its middle to 0 at its rim
    val Seq(v) = pixel(image, 10, 4)("v"): @unchecked
    assert(v > 0.1f && v < 0.3f)
    // Flat, and seen from straight ahead
    assertClose(pixel(image, 10, 10)("dzdx", "dzdy"), 0, 0)

  test("in world space the same disk is at z = 0"):
    val space = "\"string coordinatesystem\" \"world\""
    val image = render(s"$view\n${film("gbuffer")} $space\n$world")
    assertClose(pixel(image, 10, 10)("P.Z", "N.Z"), 0, -1)

  test("a tilted disk changes its z from pixel to pixel"):
    val tilted = world.replace("Shape", "Rotate 45 0 1 0\nShape")
    val image = render(s"$view\n${film("gbuffer")}\n$tilted")
    // As wide as a pixel is (4·tan 20°/10) at the mean distance, at the scale of 4 samples
    val wide = 4 * Math.tan(Math.toRadians(20)) / 10 / 2
    val Seq(dx, dy) = pixel(image, 10, 10)("dzdx", "dzdy"): @unchecked
    assert(Math.abs(dx - wide) < 0.1 * wide && dy < 0.02 * wide, s"$dx, $dy, $wide")

  test("a moving camera's layers are in its space at the time of each ray"):
    val moving = view.replace(
      "LookAt",
      "ActiveTransform EndTime\nTranslate 0 0 2\nActiveTransform All\nLookAt"
    )
    val image = render(s"$moving\n${film("gbuffer")}\n$world")
    // The world moves away from the camera, from 4 to 6
    val Seq(z) = pixel(image, 10, 10)("P.Z"): @unchecked
    assert(z > 4.2f && z < 5.8f)

  test("any scene can be asked for layers, which cost nothing where they are not"):
    val text = s"PixelFilter \"box\"\n$view\n${film("rgb")}\n$world"
    val asked = BuildOptions(layers = Vector(Layer.Depth, Layer.Samples))
    val image = render(text, asked)
    assert(image.channelNames == Image.RgbNames ++ Vector("Z", "samples"))
    val Seq(depth, samples) = pixel(image, 10, 10)("Z", "samples"): @unchecked
    assert(depth > 4f && depth < 4.02f && samples == 4f)
    val plain = render(text)
    assert(plain.channelNames == Image.RgbNames)
    val colors = (0 until 400).flatMap(i => pixel(image, i % 20, i / 20)("R", "G", "B"))
    assert(colors == plain.data.toSeq)
    val plan = SceneTexts.plan(text, Dialect.V4)
    assert(plan.layers.isEmpty && plan.differentialScale == 0f)

  test("samples are shared where a filter reaches beyond the pixel, but for images with layers"):
    def shares(filter: String, film: String, integrator: String = "volpath") =
      val text = s"Integrator \"$integrator\" PixelFilter $filter $view $film\n$world"
      SceneTexts.plan(text, Dialect.V4).sharesSamples
    val wide = "\"triangle\" \"float xradius\" 1 \"float yradius\" 1"
    assert(shares(wide, film("rgb")) && shares("\"gaussian\"", film("rgb"), "path"))
    assert(!shares("\"box\"", film("rgb")) && !shares(wide, film("gbuffer")))
    assert(!shares(wide, film("rgb"), "bdpt") && !shares(wide, film("rgb"), "sppm"))

  test("the sensors of cameras are known by name, and what they see is said"):
    def said(name: String) =
      val sensor = s"\"string sensor\" \"$name\""
      SceneTexts.problems(s"$view\n${film("rgb")} $sensor\n$world", Dialect.V4).map(_.message)
    assert(said("cie1931").isEmpty)
    assert(said("nikon_d850").exists(_.contains("responds to a smooth spectrum")))
    assert(said("nikon").exists(_.contains("unknown sensor \"nikon\"")))

  test("spectral images have bands of wavelengths, and say how they were found"):
    val said = SceneTexts.problems(s"$view\n${film("spectral")}\n$world", Dialect.V4)
    assert(said.exists(_.message.contains("RGB, not spectral")))
    val image = render(s"$view\n${film("spectral")} \"integer nbuckets\" 5\n$world")
    assert(image.channelNames.take(4) == Image.RgbNames :+ "S0.407,000nm" && image.channels == 8)
    // Half of light of luminance 1, in the sky
    assert(pixel(image, 0, 0)("S0.595,000nm").forall(s => s > 0.4f && s < 0.6f))
    def wrong(parameters: String) =
      SceneTexts.problems(s"$view\n${film("spectral")} $parameters\n$world", Dialect.V4)
    assert(wrong("\"integer nbuckets\" 0").exists(_.message.contains("must be at least 1")))
    assert(wrong("\"float lambdamin\" 300").exists(_.message.contains("360 and 830 nm")))

  test("the layers are pbrt-v4's"):
    val reference = ImageFiles.read(Path.of("reference-images", "v4-gbuffer.exr"))
    val description = Parser.parse(Path.of("scenes", "v4-gbuffer.pbrt"))
    val (plan, _) = SceneBuilder.build(description, BuildOptions(spp = Some(16)))
    val image = Renderer.render(plan, threads = 2).image(plan.development)
    assert(image.channelNames.toSet == reference.channelNames.toSet)
    // pbrt's variances hold the noise of wavelengths; dzdx shrinks with the samples
    val others = Layer.gbuffer.filterNot(
      Set(Layer.Variance, Layer.RelativeVariance, Layer.Gradient)
    )
    for layer <- others; channel <- layer.channels do
      val (ours, theirs) = (values(image, channel), values(reference, channel))
      val apart = ours.lazyZip(theirs).map((a, b) => Math.abs(a - b)).sorted
      val size = theirs.map(Math.abs(_)).sum / theirs.size
      // Of pixels at an edge some are met only with more samples
      assert(Math.abs(ours.sum - theirs.sum) / theirs.size < 0.02 * size, channel)
      assert(apart(apart.size / 2) < 0.005f, channel)

  test("the bands of wavelengths are pbrt-v4's"):
    val reference = ImageFiles.read(Path.of("reference-images", "v4-spectral.exr"))
    val description = Parser.parse(Path.of("scenes", "v4-spectral.pbrt"))
    val (plan, _) = SceneBuilder.build(description, BuildOptions(spp = Some(16)))
    val image = Renderer.render(plan, threads = 2).image(plan.development)
    assert(image.channelNames.toSet == reference.channelNames.toSet)
    for channel <- reference.channelNames.filter(_.startsWith("S0.")) do
      val (ours, theirs) = (values(image, channel), values(reference, channel))
      // Spectra of muted colours, found from three numbers: 0.2 % was seen with more samples
      assert(Math.abs(ours.sum - theirs.sum) < 0.01f * theirs.sum, channel)

  private def values(image: Image, channel: String): Vector[Float] =
    val c = image.channelNames.indexOf(channel)
    Vector.tabulate(image.width * image.height)(i => image.data(i * image.channels + c))

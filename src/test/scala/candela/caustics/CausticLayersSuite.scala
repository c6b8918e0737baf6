package candela.caustics

import candela.aov.Layer
import candela.film.Fireflies
import candela.guiding.GuidingMode
import candela.image.Image
import candela.integrators.CausticsMode
import candela.render.{Renderer, RenderPlan, SplattedTiles}
import candela.scenefile.Dialect
import candela.settings.{ColorMode, LightGrouping, RenderSettings}
import candela.testing.{BlockMeans, SceneTexts}

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Light paths, where light is divided: by way, by emitter, by brightness, by wavelength. */
final class CausticLayersSuite extends AnyFunSuite:
  import CausticTracerSuite.{GlassBall, emitter, scene}

  /** Two emitters, and a ball of glass. */
  private val two = scene(
    GlassBall,
    s"""${emitter(0.7f)}
        AttributeBegin
        AreaLightSource "diffuse" "rgb L" [1 2 6]
        Translate -1.2 2 -1
        Shape "sphere" "float radius" .5
        AttributeEnd
        LightSource "infinite" "rgb L" [.05 .1 .05]"""
  )
  private val ways = Vector(Layer.Emission, Layer.Background, Layer.Direct, Layer.Indirect)
  private val divided = RenderSettings(
    Some(48),
    color = ColorMode.Rgb,
    layers = ways :+ Layer.Lights,
    lightGroups = Some(LightGrouping.Statements)
  )

  private def plan(text: String, settings: RenderSettings, mode: CausticsMode): RenderPlan =
    val made = SceneTexts.plan(text, Dialect.V4, settings.copy(caustics = Some(mode)))
    val isBeside = made.method match
      case splatted: SplattedTiles => splatted.beside
      case _ => false
    assert(isBeside == (mode != CausticsMode.Off), made.features)
    made

  private def image(text: String, settings: RenderSettings, mode: CausticsMode): Image =
    val made = plan(text, settings, mode)
    Renderer.render(made, threads = 2).image(made.development)

  private def channels(image: Image, prefix: String): Seq[Int] =
    image.channelNames.indices.filter(i => image.channelNames(i).startsWith(prefix))

  private def assertSums(image: Image, parts: Seq[String]): Assertion =
    val off =
      for c <- 0 to 2; pixel <- 0 until image.width * image.height yield
        val at = pixel * image.channels
        val whole = image.data(at + c)
        val sum = parts.map(p => image.data(at + channels(image, p)(c)).toDouble).sum
        Math.abs(whole - sum) / Math.max(whole, 0.1)
    // Rounding of the light of each event, and of the parts
    assert(off.max < 1e-4)

  private def groups(image: Image): Seq[String] =
    image.channelNames.collect { case s"Combined_$name.R" => s"Combined_$name." }

  private val text = Seq(
    "path" -> two,
    "guided" -> two,
    "volpath" -> CausticTracerSuite.inFog(two)
  )

  for (what, scene) <- text do
    test(s"light paths are divided as the camera's paths are: $what"):
      val guiding = if what == "guided" then GuidingMode.On else GuidingMode.Off
      val found = image(scene, divided.copy(guiding = Some(guiding)), CausticsMode.On)
      assert(groups(found).size == 3)
      assertSums(found, groups(found))
      assertSums(found, ways.map(_.channels.head.stripSuffix("R")))
      val expected = image(scene, divided.copy(seed = 1), CausticsMode.Off)
      for part <- groups(found) ++ Seq("Direct.", "Indirect.", "Emission.") do
        BlockMeans.assertEqual(found, expected, channels(found, part), part)

  test("so they are at wavelengths, where the pilot decides"):
    val settings = divided.copy(samples = Some(4), color = ColorMode.Spectral)
    val small = two.replace(emitter(0.7f), emitter(0.2f))
    val found = image(small, settings, CausticsMode.Auto)
    assertSums(found, groups(found))
    assertSums(found, ways.map(_.channels.head.stripSuffix("R")))

  test("layers leave the image with caustics as it is"):
    // With layers samples lie otherwise under the filter, so one has the normal
    val settings = divided.copy(layers = Vector(Layer.Normal), lightGroups = None)
    val plain = image(two, settings, CausticsMode.On)
    val parts = image(two, divided, CausticsMode.On)
    for i <- 0 until plain.width * plain.height; c <- 0 to 2 do
      assert(plain.data(i * plain.channels + c) == parts.data(i * parts.channels + c))

  test("a limit of indirect light holds for light paths, each as a sample", Slow):
    def mean(limit: Float) =
      val settings = divided.copy(layers = Vector.empty, lightGroups = None)
      val fireflies = if limit == 0f then Fireflies.Kept else Fireflies.Clamped(limit)
      val found = image(two, settings.copy(fireflies = fireflies), CausticsMode.On)
      found.data.map(_.toDouble).sum / found.data.length
    val whole = mean(0f)
    // No path is as bright; only the order of additions differs
    assert(Math.abs(mean(1e6f) / whole - 1) < 1e-5)
    assert(mean(0.05f) < 0.98 * whole)

  test("light paths fill bands of wavelengths as the camera's paths do"):
    val lit = two.replace("Film \"rgb\"", "Film \"spectral\" \"integer nbuckets\" 3")
    val settings = RenderSettings(Some(32), color = ColorMode.Spectral)
    val found = image(lit, settings, CausticsMode.On)
    val expected = image(lit, settings.copy(seed = 1), CausticsMode.Off)
    assert(channels(found, "S0.").size == 3)
    for band <- channels(found, "S0.") do
      BlockMeans.assertEqual(found, expected, Seq(band), found.channelNames(band))

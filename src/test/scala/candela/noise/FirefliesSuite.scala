package candela.noise

import candela.build.SceneBuilder
import candela.film.Fireflies
import candela.image.{Image, ImageFiles}
import candela.measure.Metrics
import candela.render.Renderer
import candela.scenefile.Parser
import candela.settings.RenderSettings

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** What is done about fireflies in a scene that has many, against pbrt-v4's image of it. */
class FirefliesSuite extends AnyFunSuite:
  private val scene = Parser.readable(Path.of("bench/scenes/fireflies.v4.pbrt"), None, false)
  private val reference = ImageFiles.read(Path.of("bench/scenes/fireflies.exr"))

  private def image(samples: Int, fireflies: Fireflies, threads: Int = 2): Image =
    val options = RenderSettings(samples = Some(samples), seed = 3, fireflies = fireflies)
    val plan = SceneBuilder.build(scene, options)._1.piloted
    Renderer.render(plan, threads).image(plan.development)

  private def error(image: Image) = Metrics.compare(image, reference).relativeMse
  private def brightness(image: Image) =
    image.data.map(_.toDouble).sum / reference.data.map(_.toDouble).sum

  test("re-weighted, an image has far less noise, and converges to pbrt's", Slow):
    val (few, fewKept) = (image(64, Fireflies.Reweighted), image(64, Fireflies.Kept))
    assert(error(few) < error(fewKept) / 4)
    val many = image(1024, Fireflies.Reweighted)
    assert(error(many) < error(few) / 2)
    // The reference's own mean is known to 0.2 %; the noise of 1024 samples is 1 %
    assert(Math.abs(brightness(many) - 1) < 0.02, brightness(many))

  test("limited indirect light has little noise, and keeps its bias", Slow):
    assert(error(image(64, Fireflies.Clamped(4))) < 0.1)
    assert(brightness(image(512, Fireflies.Clamped(4))) < 0.97)

  test("emitters seen directly are not limited"):
    def most(image: Image) = image.data.max
    assert(most(image(4, Fireflies.Clamped(1e-3f))) > 100)

  test("a limit above all samples changes nothing but roundings"):
    val (kept, limited) = (image(4, Fireflies.Kept), image(4, Fireflies.Clamped(1e9f)))
    for (a, b) <- kept.data.zip(limited.data) do assert(Math.abs(a - b) <= 1e-5f * Math.abs(a))

  test("the image is the same for any number of threads, bit for bit"):
    for fireflies <- Vector(Fireflies.Reweighted, Fireflies.Clamped(2)) do
      val one = image(16, fireflies, threads = 1)
      assert(one.data.sameElements(image(16, fireflies, threads = 3).data))

package candela.measure

import candela.color.{Encoding, Srgb}
import candela.image.{Image, ImageError}
import org.scalatest.funsuite.AnyFunSuite

class MetricsSuite extends AnyFunSuite:

  private def rgb(width: Int, values: Float*): Image =
    Image(width, values.size / 3 / width, Image.RgbNames, values.toArray)

  // Sums of a few Doubles made of Floats.
  private def near(found: Double, wanted: Double): Boolean =
    Math.abs(found - wanted) <= 1e-6 * Math.max(1.0, Math.abs(wanted))

  test("equal pictures differ by nothing"):
    val image = rgb(2, 0f, 0.5f, 1f, 2f, 3f, 4f)
    val m = Metrics.compare(image, image)
    assert(m.mse == 0 && m.relativeMse == 0 && m.psnr == Double.PositiveInfinity)
    assert(m.meanRatio == Vector(1.0, 1.0, 1.0) && m.largest.value == 0 && m.skipped == 0)

  test("figures follow their definitions"):
    val image = rgb(2, 1f, 0.5f, 0.25f, 0f, 1f, 0.5f)
    val reference = rgb(2, 0.5f, 0.5f, 0.25f, 0f, 0.5f, 1f)
    val m = Metrics.compare(image, reference)
    assert(near(m.mse, 0.75 / 6))
    def relative(a: Double, b: Double) = Math.pow((a - b) / (b + 0.01), 2)
    assert(near(m.relativeMse, (2 * relative(1, 0.5) + relative(0.5, 1)) / 6))
    val shown = Math.pow(1 - Srgb.encode(0.5f), 2)
    assert(near(m.psnr, -10 * Math.log10(3 * shown / 6)))
    assert(near(m.meanRatio(0), 2) && near(m.meanRatio(1), 1.5) && near(m.meanRatio(2), 0.6))
    assert(m.largest == LargestDifference(0.5, 0, 0, "R"))

  test("PSNR does not see what a screen clamps"):
    assert(Metrics.compare(rgb(1, 5f, -1f, 1f), rgb(1, 9f, 0f, 2f)).psnr == Double.PositiveInfinity)

  test("the largest difference is located"):
    val m = Metrics.compare(rgb(2, 0f, 0f, 0f, 0f, -3f, 0f), rgb(2, 1f, 0f, 0f, 0f, 0f, 2f))
    assert(m.largest == LargestDifference(3, 1, 0, "G"))

  test("pixels that are not finite in one of the two are counted and left out"):
    val image = rgb(3, 1f, 1f, Float.NaN, 2f, 2f, 2f, 0f, 0f, 0f)
    val reference = rgb(3, 1f, 1f, 1f, 2f, 2f, 2f, 0f, Float.PositiveInfinity, 0f)
    val m = Metrics.compare(image, reference)
    assert(m.skipped == 2 && m.mse == 0 && m.meanRatio.forall(_ == 1.0))
    val nothing = rgb(1, Float.NaN, 0f, 0f)
    assert(intercept[ImageError](Metrics.compare(nothing, nothing)).getMessage.contains("no pixel"))

  test("a reference of black gives finite relative errors and honest ratios"):
    val m = Metrics.compare(rgb(1, 0.01f, 0f, 0f), rgb(1, 0f, 0f, 0f))
    assert(near(m.relativeMse, 1.0 / 3))
    assert(m.meanRatio == Vector(Double.PositiveInfinity, 1.0, 1.0))

  test("different sizes and channels are errors that name both"):
    def error(a: Image, b: Image) = intercept[ImageError](Metrics.compare(a, b)).getMessage
    val wide = Image.rgb(3, 2)
    assert(error(wide, Image.rgb(2, 3)) == "image sizes differ: 3×2 and 2×3 pixels; " +
      "render with --resolution 2x3, or resize or cut one with `candela image`")
    val gray = Image(3, 2, Vector("Y"), new Array[Float](6))
    assert(error(wide, gray) == "image channels differ: R, G, B and Y")

  test("channels of a layer are those without it of a reference that lacks the layer"):
    val names = Vector("R", "G", "B", "Denoised.R", "Denoised.G", "Denoised.B")
    val image = Image(1, 1, names, Array(9f, 9f, 9f, 0.1f, 0.2f, 0.3f))
    val layer = names.drop(3)
    val plain = ImagePair.of(image, rgb(1, 0.1f, 0.2f, 0.5f), layer)
    assert(plain.channels == Image.RgbNames)
    assert(plain.difference.data.toVector == Vector(0f, 0f, 0.5f - 0.3f))
    assert(ImagePair.of(image, image, layer).channels == layer)
    val mute = Image(1, 1, Vector("Y"), Array(0f))
    val error = intercept[ImageError](ImagePair.of(image, mute, layer)).getMessage
    assert(error == "the reference has no channel R, G, B; known: Y")

  test("colours are compared by name, other channels ignored, and encoded pictures decoded"):
    val bgra = Image(1, 1, Vector("B", "G", "R", "A"), Array(0.3f, 0.2f, 0.1f, 1f))
    assert(Metrics.compare(bgra, rgb(1, 0.1f, 0.2f, 0.3f)).mse == 0)
    val encoded = Image(1, 1, Image.RgbNames, Array(0.5f, 0f, 1f), Encoding.Srgb)
    assert(Metrics.compare(encoded, rgb(1, Srgb.decode(0.5f), 0f, 1f)).mse == 0)

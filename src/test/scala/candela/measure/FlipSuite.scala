package candela.measure

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class FlipSuite extends AnyFunSuite:

  /** Smooth colours, a soft edge, and a bright spot that is clamped. */
  private def scene(shift: Double, noise: Double): Image =
    val image = Image.rgb(48, 32)
    for y <- 0 until 32; x <- 0 until 48 do
      val wave = 0.5 + 0.4 * Math.sin(0.3 * (x + shift)) * Math.cos(0.2 * y)
      val edge = if x + shift > 24 then 0.3 else 0.0
      val spot = if (x - 10) * (x - 10) + (y - 8) * (y - 8) < 6 then 4.0 else 0.0
      // A pattern that is no wave: the golden ratio's multiples are spread evenly.
      val grain = noise * (((x * 7 + y * 13) * 0.6180339887 % 1) - 0.5)
      val values = Vector(wave + grain, 0.6 * wave + edge - grain, 0.9 - wave + spot)
      for c <- 0 until 3 do image.data(3 * (y * 48 + x) + c) = values(c).toFloat
    image

  private def mean(a: Image, b: Image): Double = Flip.mean(ImagePair(a, b))

  test("equal pictures have no error, and black against white has nearly all"):
    val image = scene(0, 0.1)
    assert(mean(image, image) == 0)
    val (black, white) = (Image.rgb(24, 24), Image.rgb(24, 24))
    java.util.Arrays.fill(white.data, 1f)
    // The largest difference of the map is that of green and blue; this one is near.
    assert(Math.abs(mean(black, white) - 0.967386) < 2e-4)

  test("figures agree with those of the authors' own program"):
    // flip-evaluator 1.7 from PyPI, of the same numbers, clamped, as LDR
    assert(Math.abs(mean(scene(0.7, 0), scene(0, 0)) - 0.192776) < 2e-4)
    assert(Math.abs(mean(scene(0, 0.2), scene(0, 0)) - 0.099902) < 2e-4)

  test("it does not matter which of the two is the reference"):
    val (a, b) = (scene(0.7, 0.1), scene(0, 0))
    assert(Math.abs(mean(a, b) - mean(b, a)) < 1e-9)

  test("what a screen clamps is not seen, and pixels that are no numbers are left out"):
    val (a, b) = (scene(0, 0), scene(0, 0))
    a.data(3 * (8 * 48 + 10) + 2) = 1000f
    assert(mean(a, b) == 0)
    a.data(0) = Float.NaN
    a.data(1) = Float.PositiveInfinity
    a.data(2) = Float.NegativeInfinity
    assert(mean(a, b) == 0)
    // The mean is that of the others
    val (black, white) = (Image.rgb(48, 32), Image.rgb(48, 32))
    java.util.Arrays.fill(white.data, 1f)
    white.data(0) = Float.NaN
    val pair = ImagePair(white, black)
    val map = Flip.map(pair)
    assert(map.data(0) == 0 && map.data(1) > 0)
    assert(Math.abs(Flip.mean(pair) - map.data.map(_.toDouble).sum / (48 * 32 - 1)) < 1e-9)

package candela.render

import java.util.SplittableRandom

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** The statistic of [[RenderSuite]], on images whose truth is known. */
class AgreementSuite extends AnyFunSuite:
  private val width = 96
  private val height = 72
  private val significance = 0.001

  /** A gradient with some dark and some bright places. */
  private def truth(x: Int, y: Int, c: Int): Double =
    0.1 + (x + c) / 100.0 + (if y > 60 then 0.4 else 0)

  private def noisy(seed: Long, relative: Double, change: (Int, Int, Double) => Double): Image =
    val random = java.util.Random(seed)
    val image = Image.rgb(width, height)
    for y <- 0 until height; x <- 0 until width; c <- 0 until 3 do
      val value = change(x, y, truth(x, y, c))
      // a noise that is uneven in space, as in real images
      val sigma = relative * value * (1 + 3 * (x % 16) / 16.0)
      image.data(3 * (y * width + x) + c) = (value + sigma * random.nextGaussian()).toFloat
    image

  private val same = (_: Int, _: Int, v: Double) => v

  /** Four renderings with 5 % noise or more, and a reference with 0.6 %. */
  private def found(seed: Long, allowance: Double = 0)(change: (Int, Int, Double) => Double) =
    val seeds = SplittableRandom(seed)
    val renders = Vector.fill(4)(noisy(seeds.nextLong(), 0.05, change))
    val (a, b) = (noisy(seeds.nextLong(), 0.009, same), noisy(seeds.nextLong(), 0.009, same))
    val reference =
      Image(width, height, Image.RgbNames, a.data.zip(b.data).map((p, q) => (p + q) / 2))
    val noise = a.data.zip(b.data).map((p, q) => Math.pow(p - q, 2) / 4).sum / a.data.length
    Agreement(renders, reference, noise, allowance).disagreements(significance)

  test("noise alone is no disagreement", Slow):
    // At this significance one of a thousand correct images is accused; 20 fixed seeds are not
    for seed <- 1 to 20 do
      val wrong = found(seed)(same)
      assert(wrong.isEmpty, s"seed $seed: $wrong")

  test("a whole image that is half a percent too bright is found"):
    for seed <- 1 to 5 do assert(found(seed)((_, _, v) => v * 1.005).nonEmpty, s"seed $seed")

  test("one block that is 10 % too dark is found, and named"):
    for seed <- 1 to 5 do
      val wrong = found(seed): (x, y, v) =>
        if x / 8 == 4 && y / 8 == 3 then v * 0.9 else v
      assert(wrong.exists(_.what.contains("x 32 to 39, y 24 to 31")), s"seed $seed: $wrong")

  test("errors that cancel within each block are found by the mean squared error"):
    for seed <- 1 to 5 do
      val wrong = found(seed)((x, y, v) => if (x + y) % 2 == 0 then v * 1.15 else v * 0.85)
      assert(wrong.exists(_.what.startsWith("relative mean squared error")), s"seed $seed: $wrong")

  test("the allowance covers a bias below it, and none above it"):
    for seed <- 1 to 5 do
      assert(found(seed, allowance = 0.01)((_, _, v) => v * 1.01).isEmpty, s"seed $seed")
      assert(found(seed, allowance = 0.01)((_, _, v) => v * 1.02).nonEmpty, s"seed $seed")

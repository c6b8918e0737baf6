package candela.measure

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class QuietMeansSuite extends AnyFunSuite:
  private val (width, height) = (7, 5)

  /** A pixel with another value than those around, and its standard deviation. */
  private final case class Lone(x: Int, y: Int, value: Float, deviation: Float)

  /** Its value is that of one sample. */
  private def lone(x: Int, y: Int, value: Float) = Lone(x, y, value, value)

  /** The mean of each pixel of an image of one channel, of which the left three columns see an
    * emitter. Both are quiet.
    */
  private def means(dark: Float, emitter: Float, others: Lone*): (Int, Int) => Double =
    val image = Image(width, height, Vector("Y"), new Array(width * height))
    val variance = new Array[Float](image.data.length)
    for i <- image.data.indices do
      image.data(i) = if i % width < 3 then emitter else dark
      variance(i) = 1e-4f * image.data(i) * image.data(i)
    for o <- others do
      image.data(o.y * width + o.x) = o.value
      variance(o.y * width + o.x) = o.deviation * o.deviation
    val found = QuietMeans(image, variance)
    // The weight is 1 / (mean + 0.01)²
    (x, y) => 1 / Math.sqrt(found.weight(y * width + x)) - 0.01

  test("the noisiest pixel at a light's edge before black has its own mean over the root of 2"):
    for dark <- Vector(0f, 0.04f, 1f) do
      val found = means(dark, 2000, lone(3, 2, 125))
      assert(Math.abs(found(3, 2) / (125 / Math.sqrt(2)) - 1) < 1e-4, dark)
      // Those beside it, quiet, have their own
      assert(Math.abs(found(2, 2) / 2000 - 1) < 1e-4)
      assert(Math.abs(found(4, 2) - dark) < 1e-4)

  test("so does one at the border of the image"):
    for y <- Vector(0, height - 1) do
      val found = means(0.04f, 2000, lone(3, y, 125))
      assert(Math.abs(found(3, y) / (125 / Math.sqrt(2)) - 1) < 1e-4)

  test("a firefly does not hide its own error"):
    for dark <- Vector(0f, 0.04f, 1f) do
      val found = means(dark, dark, lone(3, 2, 125))
      // Itself counts twice the others at most
      assert(Math.abs(found(3, 2) - dark * 26 / 25) < 1e-3 * (dark + 1), dark)

  test("one that is brighter than the emitter beside it is a firefly"):
    assert(means(0.04f, 10, lone(3, 2, 125))(3, 2) < 7)

  test("one that is not beside the emitter is a firefly"):
    assert(means(0.04f, 2000, lone(4, 2, 125))(4, 2) < 0.1)

  test("a noisy neighbour is no emitter"):
    def found(deviation: Float) =
      means(0.04f, 0.04f, lone(3, 2, 125), Lone(2, 2, 2000, deviation))(3, 2)
    // More than three deviations apart, the second with a variance of 1 %
    assert(found(500) < 0.1 && found(200) > 80)

  test("a quiet neighbour that is darker is no emitter"):
    val found = means(0.04f, 0.04f, Lone(3, 2, 100, 25), Lone(5, 2, 30, 20))
    // A relative variance of 1/16 takes a fourth of the surroundings: of 30, and twice that
    assert(Math.abs(found(3, 2) - (100 - 55 * 0.25)) < 0.1)

  test("a pixel before black that is as noisy as those around has their mean"):
    val all = for x <- 0 until width; y <- 0 until height yield lone(x, y, 1f + (x + y) % 2)
    val found = means(0, 0, all*)
    assert(Math.abs(found(3, 2) - 1.5) < 0.05)

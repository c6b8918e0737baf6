package candela.measure

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class LocalMeansSuite extends AnyFunSuite:
  private val (width, height) = (7, 5)

  /** The mean of the pixel in the middle, of one channel. */
  private def middle(value: (Int, Int) => Double, variance: (Int, Int) => Double): Double =
    val image = Image(width, height, Vector("Y"), new Array(width * height))
    val variances = new Array[Float](width * height)
    for y <- 0 until height; x <- 0 until width do
      image.data(y * width + x) = value(x, y).toFloat
      variances(y * width + x) = variance(x, y).toFloat
    LocalMeans(image, variances)(3, 2, 0)

  private def isMiddle(x: Int, y: Int) = x == 3 && y == 2

  test("a firefly has the mean of its neighbours"):
    // One sample of sixteen has all light
    def found(dark: Double) =
      middle(
        (x, y) => if isMiddle(x, y) then 125 else dark,
        (x, y) => if isMiddle(x, y) then 125 * 125 else 1e-4 * dark * dark
      )
    for dark <- Vector(0.0, 0.04, 1.0) do assert(Math.abs(found(dark) - dark) < 1e-6)

  test("a noisy pixel at the edge of an emitter has its own mean"):
    val edge = middle(
      (x, y) => if isMiddle(x, y) then 125 else if x < 3 then 2000 else 0.04,
      (x, y) => if isMiddle(x, y) then 125 * 125 else 1e-6
    )
    assert(Math.abs(edge / 125 - 1) < 0.15)

  test("a quiet pixel beside a firefly has its own mean"):
    val quiet = middle(
      (x, y) => if x == 2 && y == 2 then 125 else 0.5,
      (x, y) => if x == 2 && y == 2 then 125 * 125 else 1e-4
    )
    assert(Math.abs(quiet - 0.5) < 1e-4)

  test("a pixel as noisy as its neighbours has the mean of all nine"):
    val sum = middle((x, y) => if isMiddle(x, y) then 10 else 1, (_, _) => 9)
    assert(Math.abs(sum - 2) < 1e-6)

  test("without noise or neighbours the mean is the value"):
    assert(middle((x, y) => x + 10 * y, (_, _) => 0) == 23)
    val alone = Image(1, 1, Vector("Y"), Array(2f))
    assert(LocalMeans(alone, Array(4f))(0, 0, 0) == 2)
    // Pixels at the border have fewer neighbours
    val pair = LocalMeans(Image(3, 1, Vector("Y"), Array(8f, 2f, 2f)), Array(64f, 0f, 0f))
    assert(pair(1, 0, 0) == 2 && pair(0, 0, 0) == 8)

  test("the relative MSE is the mean of variances over squares"):
    val flat = LocalMeans(Image(4, 4, Vector("Y"), Array.fill(16)(0.99f)), Array.fill(16)(0.25f))
    assert(Math.abs(flat.relativeMse - 0.25) < 1e-6)

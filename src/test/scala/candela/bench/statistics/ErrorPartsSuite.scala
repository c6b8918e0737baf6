package candela.bench.statistics

import candela.image.Image
import candela.measure.{ImagePair, Metrics}
import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class ErrorPartsSuite extends AnyFunSuite:
  private val (width, height) = (60, 42)

  private def image(value: (Int, Int) => Float): Image =
    val image = Image.rgb(width, height)
    for y <- 0 until height; x <- 0 until width; c <- 0 until 3 do
      image.data((y * width + x) * 3 + c) = value(x, y)
    image

  private val flat = image((_, _) => 1f)

  private def noise(draws: Draws): Image = image((_, _) => draws.between(0.8f, 1.2f))

  /** The mean of 5 × 5 pixels around each. */
  private def blurred(of: Image): Image = image: (x, y) =>
    val around =
      for dy <- 0 until 5; dx <- 0 until 5
      yield of((x + dx) % width, (y + dy) % height, 0)
    around.sum / 25

  private def ensemble(make: Draws => Image): Vector[SpectrumBand] =
    val draws = Draws(5)
    ErrorSpectrum.ensemble(Vector.fill(20)(ErrorParts.against(ImagePair(
      make(draws),
      flat
    )).spectrum))

  test(
    "parts add up to the metrics of the image, and the spectrum's mean power is the relative MSE"
  ):
    val other = noise(Draws(1))
    other.data(300) = Float.NaN
    val pair = ImagePair(other, flat)
    val (parts, metrics) = (ErrorParts.against(pair), Metrics.compare(other, flat))
    def near(a: Double, b: Double) = Math.abs(a / b - 1) < 1e-9
    assert(near(parts.squared.sum, metrics.mse) && near(parts.relative.sum, metrics.relativeMse))
    val s = parts.spectrum
    assert(s.counts.sum == width * height && s.frequencies.head == 0)
    val mean = s.powers.zip(s.counts).map(_ * _).sum / s.counts.sum
    assert(near(mean, metrics.relativeMse))

  test("white noise has a flat spectrum, whose height is the relative MSE"):
    val level = 0.16 / 12 / (1.01 * 1.01)
    for band <- ensemble(noise) do
      // 20 seeds of at least two frequencies with χ² of two degrees each: four deviations
      assert(Math.abs(band.power / level - 1) < 0.65, band.frequency)
    val high = ensemble(noise).filter(_.frequency > 0.2)
    // Hundreds of frequencies each
    assert(high.forall(band => Math.abs(band.power / level - 1) < 0.05))

  test("blurred noise has a falling spectrum"):
    val bands = ensemble(draws => blurred(noise(draws)))
    def mean(from: Double, until: Double) =
      val own = bands.filter(b => b.frequency > from && b.frequency < until).map(_.power)
      own.sum / own.size
    assert(mean(0, 0.06) > 1.5 * mean(0.06, 0.15) && mean(0.06, 0.15) > 5 * mean(0.2, 0.8))

  test("random numbers that pixels share show as power at low frequencies"):
    // Rows have the same errors: no power but along one axis, where it is as many times as high
    val bands = ensemble: draws =>
      val row = Array.fill(width)(draws.between(0.8f, 1.2f))
      image((x, _) => row(x))
    assert(bands.head.power > 10 * bands.last.power)

  test("the worst hundredth of pixels carries its share"):
    val other = image((x, y) => if x == 3 && y == 4 then 11f else 1.1f)
    val worst = ErrorParts.against(ImagePair(other, flat)).worst
    // One pixel with a square of 100, all others of 0.01; 26 pixels are a hundredth
    assert(Math.abs(worst - (100 + 25 * 0.01) / (100 + 2519 * 0.01)) < 1e-5)

  test("errors from the mean of seeds vary by between the jackknife and normal noise"):
    // In one of three images, one pixel is off by x: as one event in three, of x² / 3 each
    def seed(x: Float) = image((i, j) => if i == 0 && j == 0 then x else 0f)
    val parts = SeedNoise.parts(Vector(seed(1f), seed(0f), seed(0f)), flat).map(_.squared)
    val own = parts.map(_(0) * width * height)
    assert(Math.abs(own.sum / 3 - 1.0 / 3) < 1e-6)
    val variance = own.map(v => (v - own.sum / 3) * (v - own.sum / 3)).sum / 2 / 3
    // The jackknife has 1 / 9 for such an event; the factor that is right for normal noise, half
    assert(Math.abs(variance - Math.sqrt(0.5) / 9) < 1e-6)

package candela.measure

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

import java.util.Random

class BatchVarianceSuite extends AnyFunSuite:
  private val (width, height) = (40, 50)

  /** Means of uniform numbers times 1, 2 and 3, growing to each of these numbers of samples. */
  private def estimated(counts: Seq[Int], scaled: Float = 1): BatchVariance =
    val random = Random(7)
    val sums = new Array[Double](3 * width * height)
    val variance = BatchVariance(width * height, 3)
    var samples = 0
    for count <- counts do
      for i <- sums.indices; _ <- samples until count do
        sums(i) += (i % 3 + 1) * random.nextDouble()
      samples = count
      val image = Image.rgb(width, height)
      for i <- sums.indices do image.data(i) = (sums(i) / samples).toFloat
      variance.add(image, Array.fill(width * height)(samples * scaled))
    variance

  private def mean(v: BatchVariance, channel: Int): Double =
    (0 until width * height).map(v(_, channel).toDouble).sum / (width * height)

  test("the expectation is the variance of the mean, whatever the batches"):
    for counts <- Seq(Seq(1, 2, 4, 8, 16, 32), Seq(3, 5, 20), 1 to 40) do
      val variance = estimated(counts)
      for c <- 0 to 2 do
        val truth = (c + 1) * (c + 1) / 12.0 / counts.last
        // 2000 pixels with at least two degrees of freedom: 2.2 %; four times that
        assert(Math.abs(mean(variance, c) / truth - 1) < 0.09, s"$counts, channel $c")
      assert(Math.abs(variance.errors(Image.rgb(
        width,
        height
      )).mse / ((1 + 4 + 9) / 36.0 / counts.last) - 1) < 0.09)

  test("weights count only relative to each other"):
    val (plain, scaled) = (estimated(Seq(1, 2, 5)), estimated(Seq(1, 2, 5), scaled = 0.25f))
    for p <- 0 until width * height do assert(Math.abs(plain(p, 1) - scaled(p, 1)) <= 1e-6)

  test("the noise is the standard deviation; before the second batch nothing is known"):
    val variance = estimated(Seq(1, 2, 4))
    val noise = variance.noise(Vector("R", "G", "B"), width)
    assert(noise(3, 2, 1) == Math.sqrt(variance(2 * width + 3, 1)).toFloat && noise(3, 2, 1) > 0)
    assert(variance.isKnown && !estimated(Seq(4)).isKnown && estimated(Seq(4))(0, 0) == 0)

  test("a pixel without new samples keeps its estimate"):
    val variance = BatchVariance(2, 1)
    def add(a: Float, b: Float, weights: Float*) =
      variance.add(Image(2, 1, Vector("Y"), Array(a, b)), weights.toArray)
    add(1, 1, 1, 1)
    add(2, 2, 2, 2)
    add(2, 4, 2, 4)
    // Batches of 1 and 3 around 2: (1 + 1) / 1 degree of freedom / 2 samples
    assert(variance(0, 0) == 1)
    // Batches of 1, 3 and twice 6 around 4: (9 + 1 + 2 · 4) / 2 / 4
    assert(variance(1, 0) == 2.25f)

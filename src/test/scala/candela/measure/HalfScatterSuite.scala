package candela.measure

import candela.concurrency.GivenUp
import candela.image.Image
import candela.sampling.{IndependentSampler, OwenSobolSampler, Sampler}

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Random

class HalfScatterSuite extends AnyFunSuite:
  private val side = 48

  /** The true relative MSE at `samples` over the estimated one. */
  private def ratio(sampler: Sampler, samples: Int, exact: Double)(
      f: Int => Sampler => Double
  ): Double =
    val sums = new Array[Double](side * side)
    val scatter = HalfScatter()
    var image = Image.rgb(side, side)
    for n <- 1 to samples do
      image = Image.rgb(side, side)
      for i <- sums.indices do
        sampler.start(i % side, i / side, n - 1)
        sums(i) += f(i)(sampler)
        for c <- 0 until 3 do image.data(3 * i + c) = (sums(i) / n).toFloat
      add(scatter, n, image)
    val squares = image.data.map(v => Metrics.relativeSquare(v, exact.toFloat))
    squares.sum / squares.length / scatter.estimate.get.at(samples).relativeMse

  private def add(scatter: HalfScatter, n: Int, image: Image, weight: Double = 0): Unit =
    val weights = Array.fill(side * side)(if weight > 0 then weight.toFloat else n.toFloat)
    val _ = scatter.add(n, image, weights, isLast = false)

  private def smooth(s: Sampler): Double =
    s.next2D()
    Math.exp(s.x + s.y / 2)
  private val smoothMean = (Math.E - 1) * 2 * (Math.sqrt(Math.E) - 1)

  // 2304 pixels: their squared errors have a mean within 3 %; the scatter, likewise
  test("the error of independent samples is estimated within 15 %"):
    for n <- Vector(8, 16, 64) do
      val result = ratio(IndependentSampler(n, 5), n, smoothMean)(_ => smooth)
      assert(Math.abs(result - 1) < 0.15, s"$n samples")

  test("that of low-discrepancy points is at most as high as their halves differ"):
    // An edge through each pixel, and light of many dimensions
    for seed <- 1 to 4; n <- Vector(16, 64) do
      val random = Random(seed)
      val edges = Array.fill(side * side)(0.5 + random.nextDouble() / 2)
      def light(pixel: Int)(s: Sampler): Double =
        s.next2D()
        val edge = edges(pixel) + (if s.x + s.y / 2 > edges(pixel) then 2 else 1)
        edge + (0 until 8).map(_ => s.next1D()).map(0.5 + _).product / 16
      val result = ratio(OwenSobolSampler(64, seed), n, 2.25 + 1.0 / 16)(light)
      // Variance falls as 1 / n to 1 / n²
      assert(result > 0.33 && result < 1.15, s"seed $seed, $n: $result")

  test("a bright path that is rare does not hide its own error"):
    // One of 200 pixels has a firefly of 300: relative to itself its error would be 1
    def firefly(s: Sampler) = 1 + (if s.next1D() < 1.0 / 3200 then 300.0 else 0.0)
    for seed <- 1 to 4 do
      val result = ratio(IndependentSampler(16, seed), 16, 1 + 300.0 / 3200)(_ => firefly)
      assert(Math.abs(result - 1) < 0.35, s"seed $seed: $result")

  test("samples that count more bring more, and do not pass for better points"):
    // From the ninth on four times the weight, and a fourth of the variance
    val random = Random(7)
    val scatter = HalfScatter()
    val sums = new Array[Double](side * side * 3)
    var weight = 0.0
    for n <- 1 to 32 do
      val w = if n <= 8 then 1.0 else 4.0
      weight += w
      for i <- sums.indices do sums(i) += w * (1 + random.nextGaussian() / Math.sqrt(w))
      val image = Image.rgb(side, side)
      for i <- sums.indices do image.data(i) = (sums(i) / weight).toFloat
      add(scatter, n, image, weight)
      // Relative to (1 + 0.01)²; each is known to 3 %
      val expected = 1 / weight / 1.0201
      if n == 16 || n == 32 then
        val relativeMse = scatter.estimate.get.at(n).relativeMse
        val _ = assert(Math.abs(relativeMse / expected - 1) < 0.12, n)

  test("the interval of an estimate holds the true error"):
    var hits = 0
    for seed <- 1 to 40 do
      val random = Random(seed)
      val scatter = HalfScatter()
      val sums = new Array[Double](side * side)
      var image = Image.rgb(side, side)
      for n <- 1 to 16 do
        image = Image.rgb(side, side)
        for i <- sums.indices do
          // A quarter of the pixels is noisy
          sums(i) += (if i % 4 == 0 then 2 * random.nextDouble() else 1)
          for c <- 0 until 3 do image.data(3 * i + c) = (sums(i) / n).toFloat
        add(scatter, n, image)
      val truth = image.data.map(v => Metrics.relativeSquare(v, 1f)).sum / image.data.length
      val estimate = scatter.estimate.get
      val interval = estimate.interval(16)
      assert(interval.estimate == estimate.at(16).relativeMse)
      // 576 noisy pixels, a third of them effective
      assert(estimate.pixels > 100 && estimate.pixels < 300)
      // A third, and 1.96 √(4 / 3 / pixels) on both sides
      val spread = Math.exp(2 * 1.96 * Math.sqrt(4 / 3.0 / estimate.pixels))
      assert(Math.abs(interval.high / interval.low / 3 / spread - 1) < 0.2)
      if interval.low <= truth && truth <= interval.high then hits += 1
    assert(hits >= 37)

  test("a continued rendering is estimated from its first power of two on"):
    val random = Random(3)
    val scatter = HalfScatter()
    val sums = new Array[Double](side * side * 3)
    for n <- 1 to 64 do
      for i <- sums.indices do sums(i) += random.nextDouble()
      val image = Image.rgb(side, side)
      for i <- sums.indices do image.data(i) = (sums(i) / n).toFloat
      if n >= 24 then add(scatter, n, image)
      val known = scatter.estimate.map(_.samples)
      assert(known == (if n < 32 then None else Some(if n < 64 then 32 else 64)))
      for e <- scatter.estimate if n == e.samples do
        assert(Math.abs(e.at(n).relativeMse * 12 * n / (1 / (0.51 * 0.51)) - 1) < 0.12, n)
    // Squared errors of each value have the same mean
    val squares = scatter.squares(128).get
    val mean = scatter.estimate.get.at(128).mse
    assert(Math.abs(squares.map(_.toDouble).sum / squares.length / mean - 1) < 1e-3)

  test("an estimate that is given up changes nothing"):
    val random = Random(4)
    val images = Vector.fill(4)(Image.rgb(side, side))
    for image <- images; i <- image.data.indices do image.data(i) = random.nextFloat()
    def estimate(scatter: HalfScatter, n: Int, isStopped: () => Boolean = GivenUp.Never) =
      val weights = Array.fill(side * side)(n.toFloat)
      scatter.add(n, images(Integer.numberOfTrailingZeros(n)), weights, isLast = false, isStopped)
    val (plain, stopped) = (HalfScatter(), HalfScatter())
    for n <- Vector(1, 2, 4, 8) do
      // At the first, and at each of the next steps that ask
      if n > 1 then
        val former = stopped.estimate
        for steps <- 0 to 40 by 20 do
          var left = steps
          val _ = intercept[GivenUp]:
            estimate(
              stopped,
              n,
              () =>
                left -= 1; left < 0
            )
        val _ = assert(stopped.estimate == former)
      assert(estimate(plain, n) == estimate(stopped, n))

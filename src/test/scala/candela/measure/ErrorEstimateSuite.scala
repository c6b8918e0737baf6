package candela.measure

import candela.base.GivenUp
import candela.image.Image
import candela.sampling.{IndependentSampler, OwenSobolSampler, Sampler}

import org.scalatest.funsuite.AnyFunSuite

class ErrorEstimateSuite extends AnyFunSuite:
  private val side = 48

  /** The true relative MSE at `samples` over the estimated one. */
  private def ratio(sampler: Sampler, samples: Int, exact: Double)(f: Sampler => Double): Double =
    val sums = new Array[Double](side * side)
    val estimate = ErrorEstimate()
    var image = Image.rgb(side, side)
    for n <- 1 to samples do
      image = Image.rgb(side, side)
      for i <- sums.indices do
        sampler.start(i % side, i / side, n - 1)
        sums(i) += f(sampler)
        for c <- 0 until 3 do image.data(3 * i + c) = (sums(i) / n).toFloat
      if Integer.bitCount(n) == 1 || Integer.bitCount(n) == 2 && (n & (n >> 1)) != 0 then
        val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), n == samples)
    val squares = image.data.map(v => Metrics.relativeSquare(v, exact.toFloat))
    squares.sum / squares.length / estimate.at(samples).get.relativeMse

  private def smooth(s: Sampler): Double =
    s.next2D()
    Math.exp(s.x + s.y / 2)
  private val smoothMean = (Math.E - 1) * 2 * (Math.sqrt(Math.E) - 1)

  // 2304 pixels: their squared errors have a mean within 3 %; the scatter, likewise
  test("the error of independent samples is estimated within 15 %"):
    for n <- Vector(8, 16, 64) do
      val found = ratio(IndependentSampler(n, 5), n, smoothMean)(smooth)
      assert(Math.abs(found - 1) < 0.15, s"$n samples")

  test("that of low-discrepancy points is less than their halves differ"):
    // The halves alone give 1.7 to 1.8 times the error; an extrapolation is less precise
    for seed <- 1 to 4 do
      val found = ratio(OwenSobolSampler(64, seed), 64, smoothMean + 1.0 / 16): s =>
        val light = smooth(s)
        light + (0 until 8).map(_ => s.next1D()).map(0.5 + _).product / 16
      assert(found > 1 / 1.5 && found < 1.5, s"seed $seed: $found")

  test("a bright path that is rare does not hide its own error"):
    // One of 200 pixels has a firefly of 300: relative to itself its error would be 1
    def firefly(s: Sampler) = 1 + (if s.next1D() < 1.0 / 3200 then 300.0 else 0.0)
    for seed <- 1 to 4 do
      val found = ratio(IndependentSampler(16, seed), 16, 1 + 300.0 / 3200)(firefly)
      assert(Math.abs(found - 1) < 0.35, s"seed $seed: $found")

  test("in between and beyond, the error goes on as it did"):
    val estimate = ErrorEstimate()
    val random = scala.util.Random(3)
    val sums = new Array[Double](side * side * 3)
    for n <- 1 to 32 do
      for i <- sums.indices do sums(i) += random.nextDouble()
      val image = Image.rgb(side, side)
      for i <- sums.indices do image.data(i) = (sums(i) / n).toFloat
      val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
    val known = estimate.at(32).get.relativeMse
    // Each error is known to 3 %, as above, and two of them tell how it goes on
    assert(Math.abs(estimate.at(64).get.relativeMse / known - 0.5) < 0.04)
    val end = estimate.samplesUntil(known / 4).get
    assert(Math.abs(end.estimate - 128) < 12 && end.low < 105 && end.high > 150)
    // The farther, the less is known
    val far = estimate.samplesUntil(known / 64).get
    assert(far.high / far.estimate > 1.1 * end.high / end.estimate)
    // What is reached before the next look is known well, and what is reached already, at once
    val soon = estimate.samplesUntil(known / 1.5).get
    assert(Math.abs(soon.estimate - 48) < 5 && soon.high < 1.2 * soon.estimate)
    assert(estimate.samplesUntil(known * 2).contains(Interval(
      32,
      32,
      32 * Math.exp(0.08 * 1.959964)
    )))

  test("an error is foretold by the mean of estimates, of which the latest counts twice"):
    val random = scala.util.Random(11)
    val estimate = ErrorEstimate()
    val goal = 1e-6
    // What each estimate says alone; the second half varies much less
    val says =
      for (n, spread) <- Vector(16 -> 1.0, 32 -> 1.0, 64 -> 0.2) yield
        val image = Image.rgb(side, side)
        for i <- image.data.indices do
          image.data(i) = (1 + spread * random.nextGaussian() / n).toFloat
        val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
        estimate.at(n).map(_.relativeMse * n / goal)
    val (earlier, latest) = (says(1).get, says(2).get)
    val found = estimate.samplesUntil(goal).get.estimate
    // Samples are told in eighths of a power of two
    assert(Math.abs(found / Math.cbrt(latest * latest * earlier) - 1) < 0.13)
    assert(Math.abs(Math.log(earlier / latest)) > 0.6)

  test("after two samples only, nothing is said of how many more it takes"):
    val estimate = ErrorEstimate()
    val random = scala.util.Random(3)
    for n <- 1 to 3 do
      val image = Image.rgb(side, side)
      for i <- image.data.indices do image.data(i) = random.nextFloat()
      val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
      val isTold = estimate.samplesUntil(1e-4).exists(_.isKnown)
      assert(isTold == (n == 3), n)

  test("samples that count more bring more, and do not pass for better points"):
    // From the ninth on four times the weight, and a fourth of the variance
    val random = scala.util.Random(7)
    val estimate = ErrorEstimate()
    val sums = new Array[Double](side * side * 3)
    var weight = 0.0
    for n <- 1 to 32 do
      val w = if n <= 8 then 1.0 else 4.0
      weight += w
      for i <- sums.indices do sums(i) += w * (1 + random.nextGaussian() / Math.sqrt(w))
      val image = Image.rgb(side, side)
      for i <- sums.indices do image.data(i) = (sums(i) / weight).toFloat
      val _ = estimate.add(n, image, Array.fill(side * side)(weight.toFloat), isLast = false)
      // Relative to (1 + 0.01)²; each is known to 3 %
      val expected = 1 / weight / 1.0201
      if n == 16 || n == 32 then
        val _ = assert(Math.abs(estimate.at(n).get.relativeMse / expected - 1) < 0.12, n)
    // 264 = 8 + 4 · 64
    val end = estimate.samplesUntil(1 / 264.0 / 1.0201).get.estimate
    assert(Math.abs(end - 72) < 8)

  test("an error that few pixels have is known to be uncertain"):
    def isOfFew(noisy: Int) =
      val estimate = ErrorEstimate()
      val random = scala.util.Random(5)
      for n <- Vector(1, 2, 4) do
        val image = Image.rgb(side, side)
        for i <- image.data.indices do
          image.data(i) = if i / 3 < noisy then random.nextFloat() else 0.5f
        val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
      assert(estimate.interval(4).get.isBounded != estimate.isOfFew)
      // An emitter's edge in a pixel: the next estimate may be a thousandth
      val end = estimate.samplesUntil(estimate.at(4).get.relativeMse / 1000).get
      assert((end.low == 4 && end.high.isInfinite) == estimate.isOfFew)
      estimate.isOfFew
    // Of 2304 pixels a third or less counts, as few halves differ much
    assert(!isOfFew(side * side) && isOfFew(9))

  test("an edge of an emitter before black is no certain error"):
    // A pixel has a hundredth of an emitter of 2000, all others are dim and slightly noisy
    val random = scala.util.Random(9)
    val sums = new Array[Double](side * side * 3)
    val estimate = ErrorEstimate()
    val edge = side * side / 2
    for n <- 1 to 16 do
      val isHit = n == 13
      for i <- sums.indices do
        sums(i) += (if i / 3 == edge then if isHit then 2000.0 else 0.0
                    else 1e-4 * random.nextDouble())
      val image = Image.rgb(side, side)
      for i <- sums.indices do image.data(i) = (sums(i) / n).toFloat
      val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
    val found = estimate.interval(16).get
    // The mean of 16 samples is 125, the true one 20: that is its relative error, over all pixels
    val truth = Math.pow((125 - 20) / 20.0, 2) / (side * side)
    assert(estimate.isOfFew && found.estimate > 100 * truth)
    assert(found.low < truth && found.low > truth / 1000 && found.high.isInfinite)

  test("the interval of an estimate holds the true error, and is open where few pixels have it"):
    var hits = 0
    for seed <- 1 to 40 do
      val random = scala.util.Random(seed)
      val estimate = ErrorEstimate()
      val sums = new Array[Double](side * side)
      var image = Image.rgb(side, side)
      for n <- 1 to 16 do
        image = Image.rgb(side, side)
        for i <- sums.indices do
          // A quarter of the pixels is noisy
          sums(i) += (if i % 4 == 0 then 2 * random.nextDouble() else 1)
          for c <- 0 until 3 do image.data(3 * i + c) = (sums(i) / n).toFloat
        val _ = estimate.add(n, image, Array.fill(side * side)(n.toFloat), isLast = false)
      val truth = image.data.map(v => Metrics.relativeSquare(v, 1f)).sum / image.data.length
      val found = estimate.interval(16).get
      assert(found.estimate == estimate.at(16).get.relativeMse)
      // By the trend deviations of 0.12 and 0.36, and by 576 / 3 pixels one of 0.083
      assert(found.isBounded && found.high / found.low < Math.exp(1.96 * (0.16 + 0.38)))
      // Errors fall more often short of the estimate than they exceed it
      assert(found.estimate / found.low > found.high / found.estimate)
      if found.low <= truth && truth <= found.high then hits += 1
    assert(hits >= 37)

  test("the gap between scatters closes, and an error takes as many samples as that says"):
    val parts = Vector(0.4, 1.0, 2.86).map(d => Array.fill(20)(d))
    val trend = ScatterTrend.of(parts, 1024)
    assert(trend.ratio < 0.48)
    assert(Math.abs(trend.times(trend.ratio) - 2) < 1e-9)
    // Later doublings bring less
    assert(trend.times(trend.ratio * trend.ratio * trend.ratio) > 8.2)
    assert(Math.abs(ScatterTrend.Independent.times(0.25) - 4) < 1e-9)
    // Ends are at most 64 samples apart
    assert(ScatterTrend.Independent.times(1 / 1.06) == 1.125)
    assert(ScatterTrend.Independent.times(1 / 1.06, 64 / 1024.0) == 1.0625)
    assert(ScatterTrend.Independent.times(1 / 2.02, 64 / 1024.0) == 2.25)
    assert(ScatterTrend.Independent.times(1e-18, 64 / 1024.0) > 1e17)

  test("what the first samples gain goes on less"):
    val parts = Vector(0.4, 1.0, 2.86).map(d => Array.fill(20)(d))
    def gain(samples: Double) = 1 - ScatterTrend.of(parts, samples).factor
    assert(gain(4) == 0)
    // Half of the gap brings a little more than half of the gain, as that is a sum of products
    assert(gain(8) / gain(1024) > 0.5 && gain(8) / gain(1024) < 0.6)
    assert(gain(16) / gain(1024) > 0.875 && gain(16) / gain(1024) < 0.93)

  test("between powers of two, the error is that of blocks of points"):
    val (pixels, parts) = (40_000, 20)
    // Squared errors of n points, added up over parts of the pixels
    val squares = Array.ofDim[Double](33, parts)
    for i <- 0 until pixels do
      val sampler = OwenSobolSampler(64, i)
      var sum = 0.0
      for n <- 1 to 32 do
        sampler.start(i % 200, i / 200, n - 1)
        val light = smooth(sampler)
        sum += light + (0 until 6).map(_ => 0.5 + sampler.next1D()).product
        val error = sum / n - smoothMean - 1
        squares(n)(i * parts / pixels) += error * error
    def variance(n: Int) = squares(n).sum
    def scatter(n: Int) = Array.tabulate(parts)(i => squares(n / 2)(i) - squares(n)(i))
    val trend = ScatterTrend.of(Vector(16, 8, 4).map(scatter), 16)
    for n <- Vector(18, 20, 24, 28, 32) do
      val found = trend.after(n / 16.0) / (variance(n) / variance(16))
      assert(Math.abs(found - 1) < 0.1, s"$n: $found")
    // No better than the power of two before
    assert(trend.after(18 / 16.0) > 0.95)
    for x <- Vector(0.3, 1.0, 1.3, 3.7) do
      assert(Math.abs(ScatterTrend.Independent.after(x) * x - 1) < 1e-9)

  test("an estimate that is given up changes nothing"):
    val random = scala.util.Random(4)
    val images = Vector.fill(4)(Image.rgb(side, side))
    for image <- images; i <- image.data.indices do image.data(i) = random.nextFloat()
    def add(to: ErrorEstimate, n: Int, isStopped: () => Boolean = GivenUp.Never) =
      val weights = Array.fill(side * side)(n.toFloat)
      to.add(n, images(Integer.numberOfTrailingZeros(n)), weights, isLast = false, isStopped)
    val (plain, stopped) = (ErrorEstimate(), ErrorEstimate())
    for n <- Vector(1, 2, 4, 8) do
      // At the first, and at each of the next steps that ask
      if n > 1 then
        val end = stopped.samplesUntil(1e-4)
        for steps <- 0 to 40 by 20 do
          var left = steps
          val _ = intercept[GivenUp]:
            add(
              stopped,
              n,
              () =>
                left -= 1; left < 0
            )
        // The look after two samples has no interval: NaN is not equal to itself
        val _ = assert(stopped.samplesUntil(1e-4).map(_.toString) == end.map(_.toString))
      assert(add(plain, n).map(_.relativeMse) == add(stopped, n).map(_.relativeMse))

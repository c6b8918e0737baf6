package candela.sampling

import candela.math.*

// between N⁻¹ (16) and N^(−3/2) (64), as 16 and 256 are no powers of the bases 3 to 13
class HaltonSamplerSuite extends SamplerLaws(HaltonSampler(_, _), sharper = 11):

  test("the first pair has one sample in each cell of 2ᵃ × 3ᵇ, for so many samples"):
    for (a, b) <- Seq((1, 1), (2, 2), (3, 1), (4, 3), (0, 4), (6, 0)); px <- 0 until 4 do
      val (columns, rows) = (1 << a, Math.pow(3, b).toInt)
      val n = columns * rows
      val cells = points(HaltonSampler(n, 3), px, 5, n, 0)
        .map((x, y) => ((x * columns).toInt, (y * rows).toInt))
      assert(cells.distinct.size == n, s"$columns × $rows, pixel $px")

  test("each dimension has one sample in each of as many intervals as its prime, and its square"):
    for (d, prime) <- Seq((0, 2), (1, 3), (4, 11), (9, 29)); n <- Seq(prime, prime * prime) do
      val numbers = singles(HaltonSampler(n, 3), 1, 2, n, d)
      assert(ElementaryIntervals.eachHoldsOne(numbers), s"base $prime")

  test("prefixes are stratified too"):
    val first = singles(HaltonSampler(1000, 3), 1, 2, 1000, 2) // base 5
    for n <- Seq(5, 25, 125, 625) do assert(ElementaryIntervals.eachHoldsOne(first.take(n)))

  test("errors have no heavier tails than those of Sobol' points"):
    // The mean of (x − ½)(y − ½) for two large bases: a lattice of few lines is far off
    def kurtosis(s: Sampler, skip: Int): Double =
      val errors =
        for px <- 0 until 64; py <- 0 until 64
        yield points(s, px, py, 16, skip).map((x, y) => (x - 0.5) * (y - 0.5)).sum
      def moment(k: Int) = errors.map(Math.pow(_, k)).sum / errors.size
      moment(4) / (moment(2) * moment(2))
    for skip <- Seq(2, 6, 14) do
      val (halton, sobol) =
        (kurtosis(HaltonSampler(16, 3), skip), kurtosis(OwenSobolSampler(16, 3), skip))
      assert(halton < sobol + 0.5, s"after $skip pairs: $halton, Sobol' $sobol") // ± 0.15

  test("past the last prime the numbers are still uniform and independent"):
    val s = HaltonSampler(1, 3)
    val numbers = (0 until 64).flatMap: px =>
      s.start(px, 0, 0)
      for _ <- 0 until HaltonSampler.Dimensions do s.next1D(): Unit
      Vector.fill(64)(s.next1D())
    // 4096 numbers of deviation 0.29: a mean of 0.5 ± 0.0045; 5 deviations
    assert(Math.abs(numbers.sum / 4096 - 0.5) < 0.0226)
    assert(numbers.distinct.size > 4090) // of 2²⁴, about one pair is equal

  test("sample numbers past the count asked for give new numbers"):
    assert(singles(HaltonSampler(8, 3), 0, 0, 64, 0).distinct.size == 64)

  test("the last interval never reaches 1"):
    val s = HaltonSampler(1 << 24, 0)
    for i <- 0 until 4096; px <- 0 until 4 do
      s.start(px, 0, (1 << 24) - 1 - i)
      s.next2D()
      assert(s.x <= OneMinusEpsilon && s.y <= OneMinusEpsilon)

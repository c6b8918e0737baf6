package candela.measure

/** The trend of the scatter between two halves of n samples, n = N, N/2 and N/4, and what of the
  * variance it leaves.
  *
  * The mean of n samples has the variance V(n), and so has that of each half V(n/2). The squared
  * difference of the halves over 4, their scatter D(n), has the expectation V(n/2) − V(n). So V(N)
  * is the sum of D(2N), D(4N), D(8N), …, which is to be extrapolated. For independent samples each
  * is half of that before, and V(N) = D(N). For low-discrepancy samples the ratio is smaller, by a
  * gap that shrinks with n where independent noise remains, such as that of indirect light.
  *
  * The first samples of a sequence are spread more evenly than later ones go on to be: what they
  * gain tells too much. Of the gap after 8 samples one half is taken, after 16 seven eighths.
  *
  * Ratios of few pixels are noisy. Their variance is known from parts of the image, and gap and
  * shrinkage are means of what is measured and what is usual, weighted by their precisions.
  */
final class ScatterTrend private (gap: Double, shrinkage: Double):

  /** V(N) / D(N): 1 for independent samples, less for others. */
  val factor: Double =
    var (sum, product, rest) = (0.0, 1.0, gap)
    for _ <- 0 until ScatterTrend.Terms do
      rest *= shrinkage
      product *= 0.5 - rest
      sum += product
    // What is left halves from term to term
    sum + product

  /** V(2N) / V(N). */
  def ratio: Double =
    val next = 0.5 - gap * shrinkage
    next * doubled.factor / factor

  private def doubled = ScatterTrend(gap * shrinkage, shrinkage)

  /** How many times N samples have at most V(N) times `part`: a doubling, or eighths of it, or
    * up to the first one smaller parts of it, `most` times N apart.
    */
  def times(part: Double, most: Double = 1): Double =
    if part >= 1 then 1
    else
      var (trend, left, doublings) = (this, part, 0)
      while left < trend.ratio && doublings < ScatterTrend.MostDoublings do
        left /= trend.ratio
        trend = trend.doubled
        doublings += 1
      // Past the next doubling, which will be measured, eighths tell enough
      val parts = if doublings > 0 then 8 else Math.max(8, Math.min(1 / most, 1024).toInt)
      val first = (1 to parts).find(k => trend.within(1 + k.toDouble / parts) <= left)
      Math.scalb(1 + first.getOrElse(parts).toDouble / parts, doublings)

  /** V(N times `times`) / V(N). */
  def after(times: Double): Double =
    var (trend, rest, product) = (this, times, 1.0)
    while rest > 2 do
      product *= trend.ratio
      trend = trend.doubled
      rest /= 2
    product * trend.within(rest)

  /** V(N times `times`) / V(N), up to two times. */
  private def within(times: Double): Double = sum(times) / (times * times)

  /** The variance of the sum of so many times N samples, relative to that of N.
    *
    * Points whose number is no power of two are blocks of falling sizes, which are such powers.
    * Later points of a sequence that is scrambled by digits (Owen) are alike to those before: a
    * part r of the block of size B that follows as many has as large a part of their covariance,
    * which the variances of B and 2 B samples tell. So the sum of B + r samples has the variance
    * S(B) + S(r) + r / B (S(2 B) − 2 S(B)), where S(n) = n² V(n). Independent ones have S(n) ~ n.
    */
  private def sum(times: Double): Double =
    val smallest = ScatterTrend.Depth
    var size = -1
    while size < smallest && Math.scalb(1.0, -size) > times do size += 1
    val block = Math.scalb(1.0, -size)
    if block > times then times / block * sums(size + 1)
    else
      val rest = times - block
      if size < 0 || rest == 0 then sums(size + 1)
      else
        val share = rest / block
        (1 - 2 * share) * sums(size + 1) + sum(rest) + share * sums(size)

  /** S of 2 N, N, N/2, N/4 and N/8, relative to S(N). */
  private lazy val sums: Array[Double] =
    val found = new Array[Double](ScatterTrend.Depth + 2)
    found(0) = 4 * ratio
    found(1) = 1
    var (variance, scatter, earlier) = (1.0, 1 / factor, gap)
    for i <- 2 until found.length do
      // V(n/2) = V(n) + D(n)
      variance += scatter
      found(i) = Math.scalb(variance, -2 * (i - 1))
      scatter /= 0.5 - earlier
      earlier = Math.min(ScatterTrend.MostGap, earlier / shrinkage)
    found

object ScatterTrend:
  private val Terms = 24
  private val MostDoublings = 60
  private val MostGap = 0.25

  /** Halvings of a block of samples; smaller ones are as if samples were independent. */
  private val Depth = 3

  /** Of independent samples. */
  val Independent: ScatterTrend = new ScatterTrend(0, 1)

  // Means and variances about as in the scenes of docs/NOISE.md. The large gap of smooth direct
  // light stays longer than one that is soon lost in independent noise
  private def usualShrinkage(gap: Double) =
    Known(Math.max(0.8, Math.min(0.9, 0.55 + 2 * gap)), 0.003)
  private def UsualGap = Known(0.08, 0.01)

  /** The part of a gap after so many samples that is no peculiarity of the first ones. */
  private def goesOn(samples: Double) = Math.max(0, 1 - 32 / (samples * samples))

  private def apply(gap: Double, shrinkage: Double) = new ScatterTrend(gap, shrinkage)

  /** @param scatters sums of D(N), D(N/2), D(N/4) over each of several parts of the image
    * @param samples N
    */
  def of(scatters: Vector[Array[Double]], samples: Double): ScatterTrend =
    val Vector(now, half, quarter) = scatters: @unchecked
    (gapOf(now, half), gapOf(half, quarter)) match
      case (Some(last), Some(before)) =>
        val old = before.and(UsualGap).atLeast(1e-3)
        val usual = usualShrinkage(old.mean)
        val measured = (last.variance + usual.mean * usual.mean * old.variance) / old.square
        val found = Known(last.mean / old.mean, measured).and(usual)
        val shrinkage = Math.max(0.4, Math.min(1, found.mean))
        val expected = Known(
          shrinkage * old.mean,
          shrinkage * shrinkage * old.variance + old.square * found.variance
        )
        val gap = last.and(expected).mean * goesOn(samples)
        ScatterTrend(Math.max(0, Math.min(MostGap, gap)), shrinkage)
      case _ => Independent

  /** ½ − ΣD(n) / ΣD(n/2). */
  private def gapOf(now: Array[Double], before: Array[Double]): Option[Known] =
    val sum = before.sum
    Option.when(sum > 0):
      val ratio = now.sum / sum
      val residuals = now.indices.map(i => now(i) - ratio * before(i))
      Known(0.5 - ratio, residuals.map(r => r * r).sum / (sum * sum))

  /** An estimate and its variance. */
  private final case class Known(mean: Double, variance: Double):
    def square: Double = mean * mean
    def atLeast(least: Double): Known = copy(mean = Math.max(mean, least))

    /** Both together, weighted by their precisions. */
    def and(other: Known): Known =
      val all = Math.max(variance + other.variance, 1e-30)
      val share = variance / all
      Known(mean + (other.mean - mean) * share, variance * other.variance / all)

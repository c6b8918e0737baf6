package candela.sampling

/** Running sums as flat Float data: those of a row of n weights are n + 1 numbers from 0 to 1 that
  * never fall. A bin's probability is the difference of its two sums, as stored: what is sampled
  * and what is reported as density is the same to the last bit, whatever the sums lost by rounding.
  */
private[sampling] object Cdf:

  /** Writes the sums of `count` weights; equal shares if all weights are zero.
    *
    * @return the total of the weights
    */
  def write(weights: Array[Float], from: Int, count: Int, cdf: Array[Float], to: Int): Double =
    var total = 0.0
    var i = 0
    while i < count do
      val w = weights(from + i)
      require(w >= 0f && w < Float.PositiveInfinity, s"weight $i is $w")
      total += w
      i += 1
    cdf(to) = 0f
    var sum = 0.0
    i = 0
    while i < count do
      sum += weights(from + i)
      val share = if total > 0 then sum / total else (i + 1.0) / count
      cdf(to + i + 1) = share.toFloat
      i += 1
    cdf(to + count) = 1f
    total

  /** The bin i < `count` whose half-open interval of sums holds `u` in [0, 1). Its probability is
    * above zero.
    */
  def find(cdf: Array[Float], at: Int, count: Int, u: Float): Int =
    // the last i with sum(i) ≤ u: bins of probability zero have their successor's sum, so they lose
    var low = 0
    var high = count
    while high - low > 1 do
      val middle = (low + high) >>> 1
      if cdf(at + middle) <= u then low = middle else high = middle
    low

  /** Where in its bin `u` lies, in [0, 1). */
  def within(cdf: Array[Float], at: Int, bin: Int, u: Float): Float =
    val low = cdf(at + bin)
    Math.min((u - low) / (cdf(at + bin + 1) - low), candela.math.OneMinusEpsilon)

  /** A place in bin `bin` of `count` equal ones over [0, 1), which [[binOf]] finds again. */
  def place(bin: Int, fraction: Float, count: Int): Float =
    var x = Math.min((bin + fraction) / count, candela.math.OneMinusEpsilon)
    while binOf(x, count) > bin do x = Math.nextDown(x)
    while binOf(x, count) < bin do x = Math.nextUp(x)
    x

  def binOf(x: Float, count: Int): Int =
    candela.math.clamp((x * count).toInt, 0, count - 1)

package candela.sampling

import candela.base.loop
import candela.math.*

/** Cumulative distribution functions in flat Float arrays: n weights have n + 1 non-decreasing
  * numbers from 0 to 1. A bin's probability is the difference of its two entries, as stored:
  * sampling and pdf agree to the last bit, whatever the sums lost by rounding.
  */
private[sampling] object Cdf:

  /** Writes the CDF of `count` weights; uniform if all weights are zero.
    *
    * @return the sum of the weights
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

  /** The bin i < `count` whose half-open CDF interval contains `u` in [0, 1). Its probability is
    * positive.
    */
  def findBin(cdf: Array[Float], at: Int, count: Int, u: Float): Int =
    // The last i with sum(i) ≤ u: bins of probability zero have their successor's sum, so they are
    // never selected
    search(cdf, at, 0, count, u)

  /** As [[findBin]], for a bin from `first` until `end`. Compares bits, which have the order of
    * Floats that are not negative: no branch, since which half comes next can't be predicted.
    */
  private def search(cdf: Array[Float], at: Int, first: Int, end: Int, u: Float): Int =
    val goal = java.lang.Float.floatToRawIntBits(u)
    var low = first
    var remaining = end - first
    while remaining > 1 do
      val step = remaining >>> 1
      val beyond = (goal - java.lang.Float.floatToRawIntBits(cdf(at + low + step))) >> 31
      low += step & ~beyond
      remaining -= step
    low

  /** Number of cutpoints of a CDF of `count` bins, for a search of few steps: a power of two, so
    * that multiples of its inverse are exact.
    */
  def cutpoints(count: Int): Int = Math.max(1, Integer.highestOneBit(count) / BinsOfCutpoint)

  /** Writes the bins at 0, 1/n, 2/n, … 1, n + 1 numbers, for `n` cutpoints.
    *
    * Source: Chen and Asau, "On Generating Random Variates from an Empirical Distribution", AIIE
    * Transactions 6(2), 1974.
    */
  def writeCutpoints(
      cdf: Array[Float],
      at: Int,
      count: Int,
      n: Int,
      bins: Array[Int],
      to: Int
  ): Unit =
    var bin = 0
    loop(n): k =>
      while bin + 1 < count && cdf(at + bin + 1) <= k.toFloat / n do bin += 1
      bins(to + k) = bin
    bins(to + n) = count - 1

  /** The same bin as [[findBin]]'s, between the two next cutpoints: fewer branches to guess, and
    * less memory to visit.
    */
  def findBin(cdf: Array[Float], at: Int, u: Float, n: Int, bins: Array[Int], from: Int): Int =
    val k = from + (u * n).toInt
    search(cdf, at, bins(k), bins(k + 1) + 1, u)

  private inline val BinsOfCutpoint = 8

  /** Relative position of `u` in its bin, in [0, 1). */
  def relativePosition(cdf: Array[Float], at: Int, bin: Int, u: Float): Float =
    val low = cdf(at + bin)
    belowOne((u - low) / (cdf(at + bin + 1) - low))

  /** A position in bin `bin` of `count` equal bins over [0, 1); [[binOf]] inverts it. */
  def position(bin: Int, fraction: Float, count: Int): Float =
    var x = belowOne((bin + fraction) / count)
    while binOf(x, count) > bin do x = Math.nextDown(x)
    while binOf(x, count) < bin do x = Math.nextUp(x)
    x

  def binOf(x: Float, count: Int): Int =
    candela.math.clamp((x * count).toInt, 0, count - 1)

/** Discrete distribution over n weighted items; uniform if all weights are zero. Immutable.
  *
  * The sampled index increases with the random number, so a well-distributed sequence of numbers
  * yields a well-distributed sequence of indices (an alias table would shuffle them).
  */
final class Discrete(weights: Array[Float]):
  require(weights.length > 0, "a discrete distribution needs at least one weight")

  private val cdf = new Array[Float](weights.length + 1)

  Cdf.write(weights, 0, weights.length, cdf, 0): Unit

  def size: Int = cdf.length - 1

  /** Samples an index for `u` in [0, 1); never one of probability 0. */
  def sample(u: Float): Int = Cdf.findBin(cdf, 0, size, u)

  /** Reuses `u` after it sampled `picked`: uniform in [0, 1) again, with fewer bits. */
  def remapped(u: Float, picked: Int): Float = Cdf.relativePosition(cdf, 0, picked, u)

  /** Probability with which `sample` returns `index`. */
  def probability(index: Int): Float = cdf(index + 1) - cdf(index)

object Discrete:
  /** A power as a weight: the powers of lights in boundless scenes are infinite. */
  def weight(power: Float): Float = if power > 0f then Math.min(power, Float.MaxValue) else 0f

/** Piecewise-constant distribution over [0, 1) with n equal bins; uniform if the function is all
  * zero. Immutable.
  *
  * Source: PBRT 3rd ed., §13.3.1.
  */
final class Distribution1D(values: Array[Float]):
  require(values.length > 0, "a distribution needs at least one value")

  private val cdf = new Array[Float](values.length + 1)

  Cdf.write(values, 0, values.length, cdf, 0): Unit

  def size: Int = cdf.length - 1

  /** Samples a position for `u` in [0, 1); the result is in [0, 1). */
  def sample(u: Float): Float =
    val bin = Cdf.findBin(cdf, 0, size, u)
    Cdf.position(bin, Cdf.relativePosition(cdf, 0, bin, u), size)

  /** Pdf of `sample` at `x`; 0 outside [0, 1]. */
  def pdf(x: Float): Float =
    if x < 0f || x > 1f then 0f
    else
      val bin = Cdf.binOf(x, size)
      (cdf(bin + 1) - cdf(bin)) * size

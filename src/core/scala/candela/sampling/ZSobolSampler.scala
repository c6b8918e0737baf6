package candela.sampling

/** One Owen-scrambled (0,2)-sequence for the whole image, distributed along a Morton curve whose
  * quadrants are shuffled at every level. Neighbouring pixels share one well-distributed point set,
  * so the error of an image is high-frequency ("blue") noise, which the eye and filters suppress.
  *
  * For every request, the joint samples of each aligned 2ᵏ × 2ᵏ block of pixels put one point into
  * each elementary interval. Prefixes of a pixel's samples have no such guarantee. Samples beyond
  * the planned ones are sets of their own, scrambled anew.
  *
  * In pbrt: `zsobol` (v4's default).
  *
  * Source: Ahmed & Wonka, "Screen-space blue-noise diffusion of Monte Carlo sampling error via
  * hierarchical ordering of pixels", ACM TOG 39(6), 2020.
  *
  * @param requested samples per pixel, rounded up to a power of two
  * @param width     of the full image in pixels; with `height` it bounds the pixels passed to
  *   `start`
  */
final class ZSobolSampler(requested: Int, width: Int, height: Int, seed: Int) extends HashedSampler:
  require(requested > 0 && requested <= ZSobolSampler.MaxSamples, s"$requested samples per pixel")

  private val logSamples = ZSobolSampler.ceilLog2(requested)
  val samplesPerPixel: Int = 1 << logSamples

  /** Lowest bit of the most significant base-4 digit of a curve position. */
  private val topShift =
    2 * ZSobolSampler.ceilLog2(Math.max(width, height)) + logSamples - 2

  private var mortonIndex = 0L // along the curve, samples of a pixel side by side

  def start(x: Int, y: Int, sample: Int): Unit =
    val set = sample >>> logSamples
    startAt(SampleHash.mix64(seed + (set + 1) * SampleHash.Step))
    val number = sample - (set << logSamples)
    mortonIndex = (ZSobolSampler.spread(x) | ZSobolSampler.spread(y) << 1) << logSamples | number

  def next1D(): Float =
    val bits = nextBits()
    fraction(Sobol.scramble(shuffled(bits).toInt, bits.toInt))

  def next2D(): Unit =
    val bits = nextBits()
    val index = shuffled(bits)
    x = fraction(Sobol.scramble(index.toInt, bits.toInt))
    y = fraction(Sobol.scramble(Sobol.second(index).toInt, (bits >>> 32).toInt))

  def copy(): ZSobolSampler = ZSobolSampler(requested, width, height, seed)

  /** The point for this position: each base-4 digit goes through a permutation that depends on the
    * digits above it. If the sample count is no power of four, the last digit is binary.
    */
  private def shuffled(bits: Long): Long =
    val key = SampleHash.mix((bits >>> 16).toInt)
    var index = 0L
    var shift = topShift
    while shift >= 0 do
      val digit = (mortonIndex >>> shift).toInt & 3
      index |= ZSobolSampler.permuted(digit, random(key, mortonIndex >>> (shift + 2))) << shift
      shift -= 2
    if shift == -1 then index | ((mortonIndex ^ random(key, mortonIndex >>> 1)) & 1) else index

  /** Random bits for the digit that follows `prefix`. */
  private def random(key: Int, prefix: Long): Int =
    SampleHash.mix(key ^ (prefix ^ (prefix >>> 32)).toInt)

  private def fraction(reversed: Int): Float = SampleHash.toUnit(Integer.reverse(reversed))

object ZSobolSampler:
  /** Maximum samples per pixel: with them, places along the curve fit a `Long` for films of up to
    * 2¹⁹ pixels across.
    */
  val MaxSamples: Int = 1 << 24

  /** The 24 permutations of 0, 1, 2, 3 in 8 bits each: the image of digit d is in bits 2d and 2d +
    * 1.
    */
  private val orders: Array[Int] =
    Vector(0, 1, 2, 3).permutations.map(_.zipWithIndex.map((to, d) => to << 2 * d).sum).toArray

  private def permuted(digit: Int, random: Int): Long =
    val chosen = ((random & 0xffffffffL) * 24 >>> 32).toInt
    (orders(chosen) >>> (2 * digit)) & 3

  private def ceilLog2(n: Int): Int = if n <= 1 then 0 else 32 - Integer.numberOfLeadingZeros(n - 1)

  /** Inserts a zero between all bits of `v`, for 0 ≤ `v` < 2³¹. */
  private def spread(v: Int): Long =
    var s = v & 0x7fffffffL
    s = (s | s << 16) & 0x0000ffff0000ffffL
    s = (s | s << 8) & 0x00ff00ff00ff00ffL
    s = (s | s << 4) & 0x0f0f0f0f0f0f0f0fL
    s = (s | s << 2) & 0x3333333333333333L
    (s | s << 1) & 0x5555555555555555L

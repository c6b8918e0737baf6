package candela.sampling

import candela.math.*

/** The Halton sequence: dimension `d` is the radical inverse in the `d`-th prime, scrambled per
  * pixel. The number of samples is arbitrary; those past the requested number are not stratified
  * together with the others. A prefix of bᵏ samples puts one point into each of bᵏ intervals of a
  * dimension with base b, and bᵏ·cˡ samples one into each cell of a pair.
  *
  * The scrambling is Owen's: each digit goes through a random permutation that depends on all
  * digits before it. Affine maps of digits, which are cheaper, have the same variance over all
  * pixels; but in a pixel that draws unlucky factors, two dimensions of large bases are lattices
  * with few lines, so the errors have heavy tails (kurtosis 9 instead of 3).
  *
  * From dimension [[HaltonSampler.Dimensions]] on, the numbers are independent.
  *
  * In pbrt: `halton` (v2, v3, v4). There one sequence covers the image, here each pixel.
  *
  * Sources: Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
  * multi-dimensional integrals", 1960; Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences",
  * 1995.
  */
final class HaltonSampler(val samplesPerPixel: Int, seed: Int) extends HashedSampler:
  private var index = 0
  private var dimension = 0

  def start(x: Int, y: Int, sample: Int): Unit =
    startAt(SampleHash.pixel(x, y, seed))
    index = sample
    dimension = 0

  override def skipTo(requests: Int): Unit =
    super.skipTo(requests)
    dimension = requests

  override def position: Long = dimension
  override def goTo(position: Long): Unit = skipTo(position.toInt)

  override protected def leaveOut(): Unit =
    super.leaveOut()
    dimension += 1

  override protected def leaveOut2D(): Unit =
    leaveOut()
    leaveOut()

  def next1D(): Float =
    val bits = nextBits()
    val d = dimension
    dimension = d + 1
    if d < HaltonSampler.Dimensions then radicalInverse(HaltonSampler.primes(d), bits)
    else SampleHash.toUnit((SampleHash.mix64(bits + index) >>> 32).toInt)

  def next2D(): Unit =
    x = next1D()
    y = next1D()

  def copy(): HaltonSampler = HaltonSampler(samplesPerPixel, seed)

  /** Computes as many digits as distinguish the pixel's samples. All further digits are zero before
    * scrambling and independent random digits after it: a single hash supplies them.
    */
  private def radicalInverse(base: Int, bits: Long): Float =
    var remaining = index
    var digits = 0L
    var cells = 1L
    var prefix = bits // a hash of all digits before this one
    while cells < samplesPerPixel || remaining > 0 do
      val quotient = remaining / base
      val digit = remaining - quotient * base
      digits = digits * base + Permutation.element(digit, base, prefix)
      cells *= base
      prefix = SampleHash.mix64(prefix + (digit + 1) * SampleHash.Step)
      remaining = quotient
    val tail = SampleHash.toUnit((prefix >>> 32).toInt)
    belowOne(((digits + tail) / cells.toDouble).toFloat)

object HaltonSampler:

  /** Number of dimensions with a prime base of their own: 2 to 7919. */
  inline val Dimensions = 1000

  private val primes: Array[Int] =
    val sieve = Array.fill(7920)(true)
    val result = Array.newBuilder[Int]
    for n <- 2 until sieve.length if sieve(n) do
      result += n
      for multiple <- n * n.toLong until sieve.length.toLong by n.toLong do
        sieve(multiple.toInt) = false
    result.result()

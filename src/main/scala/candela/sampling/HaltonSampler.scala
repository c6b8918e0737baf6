package candela.sampling

import candela.math.*

/** The Halton sequence: dimension `d` is the radical inverse in the `d`-th prime, each pixel
  * scrambled by itself. Any number of samples will do; those past the number asked for are not
  * stratified together with the others. A prefix of bᵏ samples puts one point into each of bᵏ
  * intervals of a dimension with base b, and bᵏ·cˡ samples one into each cell of a pair.
  *
  * The scrambling is nested as Owen's, but each digit goes through d → (a·d + c) mod b with random
  * a ≠ 0 and c instead of one of all b! orders. These maps take any two different digits to any
  * other two with equal probability, and the variance of the estimate depends on pairs of points
  * only: it is that of Owen's.
  *
  * From dimension [[HaltonSampler.Dimensions]] on, the numbers are independent random ones.
  *
  * In pbrt: `halton` (v2, v3, v4). There one sequence covers the image, here each pixel.
  *
  * Sources: Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
  * multi-dimensional integrals", 1960; Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences",
  * 1995; Matoušek, "On the L2-discrepancy for anchored boxes", J. Complexity 14, 1998, §3.
  */
final class HaltonSampler(val samplesPerPixel: Int, seed: Int) extends Sampler:
  private var counter = 0L // the same for all samples of a pixel
  private var index = 0
  private var dimension = 0

  def start(x: Int, y: Int, sample: Int): Unit =
    counter = SampleHash.pixel(x, y, seed)
    index = sample
    dimension = 0

  def next1D(): Float =
    counter += SampleHash.Step
    val bits = SampleHash.mix64(counter)
    val d = dimension
    dimension = d + 1
    if d < HaltonSampler.Dimensions then radicalInverse(HaltonSampler.primes(d), bits)
    else SampleHash.toUnit((SampleHash.mix64(bits + index) >>> 32).toInt)

  def next2D(): Unit =
    x = next1D()
    y = next1D()

  def copy(): HaltonSampler = HaltonSampler(samplesPerPixel, seed)

  /** As many digits as tell the pixel's samples apart. The digits after those are zeros before the
    * scrambling, and independent random ones after it: they come from one hash.
    */
  private def radicalInverse(base: Int, bits: Long): Float =
    var rest = index
    var digits = 0L
    var cells = 1L
    var prefix = bits // a hash of all digits before this one
    while cells < samplesPerPixel || rest > 0 do
      val quotient = rest / base
      val digit = rest - quotient * base
      val a = 1 + below(base - 1, prefix.toInt)
      val c = below(base, (prefix >>> 32).toInt)
      digits = digits * base + (a * digit + c) % base
      cells *= base
      prefix = SampleHash.mix64(prefix + (digit + 1) * SampleHash.Step)
      rest = quotient
    val tail = SampleHash.toUnit((prefix >>> 32).toInt)
    Math.min(((digits + tail) / cells.toDouble).toFloat, OneMinusEpsilon)

  private def below(n: Int, random: Int): Int = ((random & 0xffffffffL) * n >>> 32).toInt

object HaltonSampler:

  /** How many dimensions have a base of their own: the primes from 2 to 7919. */
  inline val Dimensions = 1000

  private val primes: Array[Int] =
    val sieve = Array.fill(7920)(true)
    val found = Array.newBuilder[Int]
    for n <- 2 until sieve.length if sieve(n) do
      found += n
      for multiple <- n * n.toLong until sieve.length.toLong by n.toLong do
        sieve(multiple.toInt) = false
    found.result()

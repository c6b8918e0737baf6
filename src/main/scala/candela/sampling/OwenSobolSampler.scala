package candela.sampling

/** The (0,2)-sequence, shuffled and Owen-scrambled afresh for every request and pixel ("padded").
  *
  * Every power-of-two prefix of a pixel's samples puts exactly one point into each elementary
  * interval, for single dimensions and for the pairs of `next2D`. Counts that are no power of two
  * work too, with the error of a prefix. Different requests are independent of each other.
  *
  * In pbrt: `sobol` and `paddedsobol` (v4), `sobol`, `02sequence`, `lowdiscrepancy` and
  * `maxmindist` (v3), `lowdiscrepancy` (v2); it also serves for `pmj02bn` (v4), `bestcandidate` and
  * `adaptive` (v2), whose point sets have no counterpart here.
  *
  * Source: Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020.
  */
final class OwenSobolSampler(val samplesPerPixel: Int, seed: Int) extends Sampler:
  private var counter = 0L // the same for all samples of a pixel
  private var reversedIndex = 0

  def start(x: Int, y: Int, sample: Int): Unit =
    counter = SampleHash.pixel(x, y, seed)
    reversedIndex = Integer.reverse(sample)

  def next1D(): Float =
    val bits = nextBits()
    val seedX = (bits >>> 32).toInt
    fraction(Sobol.scramble(shuffled(bits.toInt), seedX))

  def next2D(): Unit =
    val bits = nextBits()
    val index = shuffled(bits.toInt)
    val seedX = (bits >>> 32).toInt
    val seedY = SampleHash.mix(seedX ^ bits.toInt)
    x = fraction(Sobol.scramble(index, seedX))
    y = fraction(Sobol.scramble(Sobol.second(index), seedY))

  def copy(): OwenSobolSampler = OwenSobolSampler(samplesPerPixel, seed)

  /** Another order of the points, in which each aligned power-of-two block remains one. */
  private def shuffled(orderSeed: Int): Int =
    Integer.reverse(Sobol.scramble(reversedIndex, orderSeed))

  private def fraction(reversed: Int): Float = SampleHash.toUnit(Integer.reverse(reversed))

  private def nextBits(): Long =
    counter += SampleHash.Step
    SampleHash.mix64(counter)

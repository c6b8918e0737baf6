package candela.sampling

/** The Sobol' (0,2)-sequence, independently shuffled and Owen-scrambled for every request and pixel
  * ("padded").
  *
  * Every power-of-two prefix of a pixel's samples puts exactly one point into each elementary
  * interval, for single dimensions and for the pairs of `next2D`. Other sample counts work too,
  * with the error of a prefix. Different requests are independent of each other.
  *
  * In pbrt: `sobol` and `paddedsobol` (v4), `sobol`, `02sequence`, `lowdiscrepancy` and
  * `maxmindist` (v3), `lowdiscrepancy` and `adaptive` (v2); also replaces `pmj02bn` (v4) and
  * `bestcandidate` (v2), whose point sets are not implemented.
  *
  * Source: Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020.
  */
final class OwenSobolSampler(val samplesPerPixel: Int, seed: Int) extends HashedSampler:
  override def isProgressive: Boolean = true
  private var reversedIndex = 0

  def start(x: Int, y: Int, sample: Int): Unit =
    startAt(SampleHash.pixel(x, y, seed))
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
    // Reversed as one number, which takes as long as one of them
    val reversedBits = java.lang.Long.reverse(
      (Sobol.scramble(index, seedX).toLong << 32) |
        (Sobol.scramble(Sobol.second(index), seedY) & 0xffffffffL)
    )
    x = SampleHash.toUnit(reversedBits.toInt)
    y = SampleHash.toUnit((reversedBits >>> 32).toInt)

  def copy(): OwenSobolSampler = OwenSobolSampler(samplesPerPixel, seed)

  /** Shuffles the points; aligned power-of-two blocks stay together. */
  private def shuffled(orderSeed: Int): Int =
    Integer.reverse(Sobol.scramble(reversedIndex, orderSeed))

  private def fraction(reversed: Int): Float = SampleHash.toUnit(Integer.reverse(reversed))

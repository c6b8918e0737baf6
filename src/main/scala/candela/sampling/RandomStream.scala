package candela.sampling

/** Independent random numbers where nobody knows how many it will take: the collisions of a ray on
  * its way through a medium. A path seeds it with numbers of its [[Sampler]], so the image still
  * depends on neither threads nor the order of pixels. Mutable, one per worker.
  */
final class RandomStream:
  private var counter = 0L

  /** Starts anew; other seeds make other streams. */
  def seed(a: Float, b: Float): Unit =
    def bits(x: Float) = java.lang.Float.floatToRawIntBits(x) & 0xffffffffL
    counter = SampleHash.mix64(bits(a) << 32 | bits(b))

  /** In [0, 1). */
  def next(): Float =
    counter += SampleHash.Step
    SampleHash.toUnit((SampleHash.mix64(counter) >>> 32).toInt)

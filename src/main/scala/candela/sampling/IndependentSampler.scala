package candela.sampling

/** Every number independent of every other: the yardstick for the better samplers.
  *
  * In pbrt: `independent` (v4), `random` (v2, v3).
  */
final class IndependentSampler(val samplesPerPixel: Int, seed: Int) extends Sampler:
  private var counter = 0L

  def start(x: Int, y: Int, sample: Int): Unit =
    counter = SampleHash.mix64(SampleHash.pixel(x, y, seed) + sample)

  def next1D(): Float =
    SampleHash.toUnit((nextBits() >>> 32).toInt)

  def next2D(): Unit =
    val bits = nextBits()
    x = SampleHash.toUnit((bits >>> 32).toInt)
    y = SampleHash.toUnit(bits.toInt)

  def copy(): IndependentSampler = IndependentSampler(samplesPerPixel, seed)

  private def nextBits(): Long =
    counter += SampleHash.Step
    SampleHash.mix64(counter)

package candela.render

/** In which order the pieces of a rendering are done: waves of samples, each over all pieces.
  *
  * The waves grow (1, 1, 2, 4, … 64 samples per pixel), so that an image which is cut short is
  * noisy evenly, while a long rendering rarely comes back to a piece.
  */
private[render] class Waves(
    val pieces: Int,
    samplesPerPixel: Int,
    largestWave: Int = Waves.Largest
):

  // Wave w has the samples from waveStarts(w) until waveStarts(w + 1): each doubles what there is.
  private val waveStarts: Array[Int] =
    Iterator
      .iterate(0)(start => start + Math.min(Math.max(start, 1), largestWave))
      .takeWhile(_ < samplesPerPixel)
      .toArray :+ samplesPerPixel

  val waves: Int = waveStarts.length - 1

  /** One piece in one wave is one step; the steps of a wave are consecutive. */
  val steps: Long = waves.toLong * pieces

  def firstSample(wave: Int): Int = waveStarts(wave)

  /** One more than the last sample of the wave. */
  def endSample(wave: Int): Int = waveStarts(wave + 1)

  /** After which waves every pixel has 1, 2, 4, 8, … samples, and after which it has all. */
  def passes: Vector[Int] = (1 to waves).toVector.filter: end =>
    end == waves || Integer.bitCount(waveStarts(end)) == 1

private[render] object Waves:

  /** Samples per pixel. Longer visits to a piece would not be cheaper. */
  val Largest: Int = 64

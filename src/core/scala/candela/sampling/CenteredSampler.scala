package candela.sampling

/** A sampler whose camera samples all lie in the middle: of the pixel, of the lens and, if the
  * scene moves, of the shutter interval. The dimensions behind these are those of `inner`.
  */
final class CenteredSampler(inner: Sampler, moves: Boolean) extends Sampler:
  private var points, times = 0

  def samplesPerPixel: Int = inner.samplesPerPixel
  override def isProgressive: Boolean = inner.isProgressive

  def start(x: Int, y: Int, sample: Int): Unit =
    inner.start(x, y, sample)
    points = CenteredSampler.CenteredPoints
    times = if moves then 1 else 0

  override def skipTo(requests: Int): Unit =
    inner.skipTo(requests)
    points = 0
    times = 0

  override def position: Long = inner.position
  override def goTo(position: Long): Unit = inner.goTo(position)

  def next1D(): Float =
    val u = inner.next1D()
    if times > 0 then
      times -= 1
      0.5f
    else u

  def next2D(): Unit =
    inner.next2D()
    if points > 0 then
      points -= 1
      x = 0.5f
      y = 0.5f
    else
      x = inner.x
      y = inner.y

  def copy(): CenteredSampler = CenteredSampler(inner.copy(), moves)

object CenteredSampler:
  /** The points on the film and on the lens. */
  private inline val CenteredPoints = 2

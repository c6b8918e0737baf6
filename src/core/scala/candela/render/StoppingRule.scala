package candela.render

/** Decides when a rendering stops before its planned samples are taken; it does not change them.
  */
abstract class StoppingRule extends RenderListener:

  /** Whether the rendering stops after the pass that was shown to [[passed]] last. */
  def stopsAfterPass: Boolean = false

  /** Asked about ten times a second: whether the rendering stops at once, though not all pixels
    * have the same number of samples.
    *
    * @param seconds     since the start of rendering, with the time of listeners
    * @param idleSeconds since a worker last completed a sample
    */
  def stopsNow(seconds: Double, idleSeconds: Double): Boolean = false

  /** Samples per pixel to take at most before the next pass, if it looks at waves. */
  def maxSamples: Int = Int.MaxValue

  /** When it is expected to stop the rendering; none if it never does. */
  def expectedEnd: Option[ExpectedEnd] = None

object StoppingRule:
  /** All planned samples are taken. */
  object Never extends StoppingRule

/** When a rule is expected to stop a rendering, whichever comes first.
  *
  * @param seconds   since the start of rendering, with the time of listeners
  * @param isByError whether an error stops it, too
  * @param samples   for that, by the trend of the error so far; none if it can't be known yet
  */
final case class ExpectedEnd(
    seconds: Option[Double],
    isByError: Boolean,
    samples: Option[SampleRange]
)

/** Samples per pixel at which a rendering is expected to end.
  *
  * @param low  with `high`, the 95 % interval; `Int.MaxValue`: there is no upper limit
  */
final case class SampleRange(expected: Int, low: Int, high: Int):
  def map(f: Int => Int): SampleRange = SampleRange(f(expected), f(low), f(high))

  /** Not beyond this. */
  def atMost(samples: Int): SampleRange = map(Math.min(_, samples))

package candela.render

import candela.film.Film

/** A part of a rendering after which all pixels have the same number of samples.
  *
  * @param samples samples per pixel so far
  * @param begin   seconds since the start of rendering, without the listeners' time
  * @param workers busy time of each worker, in seconds
  * @param isLast  whether it completes the rendering
  * @param isWhole whether it was not shortened by [[RenderListener.most]]
  * @param clock   seconds since the start of rendering, with the listeners' time
  * @param step    fewest samples per pixel of a part; 0: the rendering may end at any time
  * @param isStopped whether the rendering is to end at once: the listener then breaks off
  */
final case class Pass(
    samples: Int,
    begin: Double,
    end: Double,
    workers: Vector[Double],
    isLast: Boolean = false,
    isWhole: Boolean = true,
    clock: Double = 0,
    step: Int = 1,
    isStopped: () => Boolean = () => false
):
  /** Whether it ends at 1, 2, 4, 8, … samples per pixel, or is the last. */
  def isMain: Boolean = isLast || Integer.bitCount(samples) == 1

/** When a listener looks at the image. All workers pause for it, and its time is excluded, so that
  * measurements don't slow down what they measure. The pause is its only cost.
  */
enum Looks:
  case Never

  /** After 1, 2, 4, 8, … samples per pixel, and at the end. */
  case Doublings

  /** Also in between, after each part of which every pixel gets equally many samples, up to 64. */
  case Waves

/** Follows a rendering, and may end it; the image is unaffected. It is called in the thread of
  * whoever renders. Several are one by [[RenderListener.all]].
  */
abstract class RenderListener:

  /** Called before the first sample. Other threads may look at `live` from then on. */
  def started(live: Live): Unit = ()

  /** Called about ten times a second, and at the end. */
  def progressed(progress: Progress): Unit = ()

  /** When [[passed]] is called. */
  def looks: Looks = Looks.Never

  /** Called before the first pass.
    *
    * @param samples samples per pixel of an earlier rendering that is continued
    */
  def begins(samples: Int, film: Film): Unit = ()

  /** Called while no sample is added; not for a cancelled pass. */
  def passed(pass: Pass, film: Film): Unit = ()

  /** Whether the image is good enough: the rendering then ends. */
  def isEnough: Boolean = false

  /** Asked about ten times a second: whether the rendering is to end at once, though not all pixels
    * have the same number of samples.
    *
    * @param seconds since the start of rendering, with the listeners' time
    * @param still   seconds since a worker last got on with its work
    */
  def isOver(seconds: Double, still: Double): Boolean = false

  /** How many samples per pixel to take at most before it looks again, if it looks at waves. */
  def most: Int = Int.MaxValue

  /** What it expects to end the rendering. */
  def goal: Option[ExpectedEnd] = None

  /** The relative error after so many samples per pixel, if it observes errors. */
  def errorAt(samples: Double): Option[Double] = None

object RenderListener:
  object Silent extends RenderListener

  def onStart(act: Live => Unit): RenderListener = new RenderListener:
    override def started(live: Live): Unit = act(live)

  def onProgress(act: Progress => Unit): RenderListener = new RenderListener:
    override def progressed(progress: Progress): Unit = act(progress)

  /** Calls all, in this order. It looks as often as any of them: each is then called at its own
    * time.
    */
  def all(listeners: Iterable[RenderListener]): RenderListener = All(listeners.toVector)

  private final class All(listeners: Vector[RenderListener]) extends RenderListener:
    override def started(live: Live): Unit = listeners.foreach(_.started(live))
    override def progressed(progress: Progress): Unit = listeners.foreach(_.progressed(progress))
    override def looks: Looks = Looks.fromOrdinal((0 +: listeners.map(_.looks.ordinal)).max)
    override def begins(samples: Int, film: Film): Unit =
      listeners.foreach(_.begins(samples, film))
    override def passed(pass: Pass, film: Film): Unit =
      for l <- listeners do
        l.looks match
          case Looks.Never => ()
          case Looks.Doublings => if pass.isMain then l.passed(pass, film)
          case Looks.Waves => l.passed(pass, film)
    override def isEnough: Boolean = listeners.exists(_.isEnough)
    override def isOver(seconds: Double, still: Double): Boolean =
      listeners.exists(_.isOver(seconds, still))
    override def most: Int = listeners.map(_.most).minOption.getOrElse(Int.MaxValue)
    override def goal: Option[ExpectedEnd] = listeners.flatMap(_.goal).headOption
    override def errorAt(samples: Double): Option[Double] =
      listeners.flatMap(_.errorAt(samples)).headOption

/** What is expected to end a rendering, whichever comes first.
  *
  * @param seconds   since the start of rendering, with the listeners' time
  * @param isByError whether an error ends it, too
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

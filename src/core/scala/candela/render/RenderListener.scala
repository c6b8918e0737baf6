package candela.render

import candela.film.Film

/** A part of a rendering after which all pixels have the same number of samples.
  *
  * @param samples       samples per pixel so far
  * @param beginSeconds  since the start of rendering, as `endSeconds` without the listeners' time
  * @param workers       busy time of each worker, in seconds
  * @param isLast        whether it completes the rendering
  * @param isUnshortened whether it was not shortened by [[StoppingRule.maxSamples]]
  * @param clock         seconds since the start of rendering, with the time of listeners
  * @param step          fewest samples per pixel of a pass; 0: the rendering may end at any time
  * @param isStopped     whether the rendering is to end at once: the listener then breaks off
  */
final case class Pass(
    samples: Int,
    beginSeconds: Double,
    endSeconds: Double,
    workers: Vector[Double],
    isLast: Boolean = false,
    isUnshortened: Boolean = true,
    clock: Double = 0,
    step: Int = 1,
    isStopped: () => Boolean = () => false
):
  /** Whether it ends at 1, 2, 4, 8, … samples per pixel, or is the last. */
  def isMain: Boolean = isLast || Integer.bitCount(samples) == 1

/** When a listener looks at the image. All workers pause for it, and its time is excluded,
  * so that measurements don't slow down what they measure. The pause is its only cost.
  */
enum Looks:
  case Never

  /** After 1, 2, 4, 8, … samples per pixel, and at the end. */
  case Doublings

  /** Also in between, after each pass in which every pixel gets equally many samples, up to 64. */
  case Waves

  def include(pass: Pass): Boolean = this == Waves || this == Doublings && pass.isMain

  /** The more frequent of both. */
  def max(other: Looks): Looks = Looks.fromOrdinal(Math.max(ordinal, other.ordinal))

/** Follows a rendering, which it does not change. The thread that renders calls it. Several are one
  * by [[RenderListener.all]].
  */
abstract class RenderListener:

  /** Called before the first sample. Other threads may look at `live` from then on. */
  def started(live: Live): Unit = ()

  /** Called about ten times a second, and at the end. */
  def progressed(progress: Progress): Unit = ()

  /** When [[passed]] is called. */
  def frequency: Looks = Looks.Never

  /** Called before the first pass.
    *
    * @param samples    samples per pixel of an earlier rendering that is continued
    * @param maxSamples of the pixel that has most of them: more if it was killed
    */
  def begins(samples: Int, maxSamples: Int, film: Film): Unit = ()

  /** Called while no sample is added; not for a cancelled pass. */
  def passed(pass: Pass, film: Film): Unit = ()

  /** The relative error after so many samples per pixel, if it measures errors. */
  def errorAt(samples: Double): Option[Double] = None

object RenderListener:
  object Silent extends RenderListener

  def onStart(act: Live => Unit): RenderListener = new RenderListener:
    override def started(live: Live): Unit = act(live)

  def onProgress(act: Progress => Unit): RenderListener = new RenderListener:
    override def progressed(progress: Progress): Unit = act(progress)

  /** Calls all, in this order, each as often as it looks. */
  def all(listeners: Iterable[RenderListener]): RenderListener = All(listeners.toVector)

  private final class All(listeners: Vector[RenderListener]) extends RenderListener:
    override def started(live: Live): Unit = listeners.foreach(_.started(live))
    override def progressed(progress: Progress): Unit = listeners.foreach(_.progressed(progress))
    override def frequency: Looks = listeners.map(_.frequency).fold(Looks.Never)(_.max(_))
    override def begins(samples: Int, maxSamples: Int, film: Film): Unit =
      listeners.foreach(_.begins(samples, maxSamples, film))
    override def passed(pass: Pass, film: Film): Unit =
      for l <- listeners if l.frequency.include(pass) do l.passed(pass, film)
    override def errorAt(samples: Double): Option[Double] =
      listeners.flatMap(_.errorAt(samples)).headOption

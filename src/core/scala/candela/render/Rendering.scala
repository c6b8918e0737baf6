package candela.render

import candela.film.{Development, Film, LayerFilm}
import candela.guiding.GuideOutcome
import candela.image.Image

/** Progress of a rendering.
  *
  * @param done    camera samples taken, of `total`
  * @param seconds elapsed time
  */
final case class Progress(
    done: Long,
    total: Long,
    seconds: Double,
    outlook: Outlook = Outlook()
):
  /** How much of the rendering is done, in [0, 1]; of one that a goal ends, of its time. */
  def part: Double =
    if outlook.hasGoal then outlook.left.fold(0.0)(l => seconds / Math.max(seconds + l, 1e-9))
    else if total == 0 then 1
    else done.toDouble / total

/** What is known about the rest of a rendering.
  *
  * @param left    seconds until it ends
  * @param rate    camera samples per second, recently
  * @param error   relative error so far, if somebody observes it
  * @param hasGoal whether something else than the number of its samples may end it
  */
final case class Outlook(
    left: Option[Double] = None,
    rate: Option[Double] = None,
    error: Option[Double] = None,
    hasGoal: Boolean = false
)

/** Requests a rendering to stop soon and return the partial image. Thread-safe. */
final class Cancellation:
  @volatile private var requested = false
  def request(): Unit = requested = true
  def isRequested: Boolean = requested

/** NaN or infinite camera samples, discarded from the image.
  *
  * @param x        pixel of the first one, with `y`: lowest sample number, then lowest row
  * @param material index of the last material that its path hit; −1: unknown
  */
final case class Refused(count: Long, x: Int, y: Int, sample: Int, material: Int = -1)

private[render] object Refused:
  /** The first, with the count of all. */
  def of(all: Vector[Refused]): Option[Refused] =
    all.minByOption(r => (r.sample, r.y, r.x)).map(_.copy(count = all.map(_.count).sum))

/** Result of a rendering.
  *
  * @param samplesPerPixel planned samples per pixel
  * @param samplesDone     samples that every pixel has at least; fewer than planned if cancelled
  * @param samplesTaken    camera samples in all pixels
  * @param rays            traced rays of all kinds
  * @param refused         discarded samples, if any
  * @param layers          requested AOVs, if any
  * @param learned         what its paths learnt, if they did
  * @param earlier         of the samples done, those of earlier runs that it continues
  */
final case class Rendering(
    film: Film,
    samplesPerPixel: Int,
    samplesDone: Int,
    samplesTaken: Long,
    rays: Long,
    seconds: Double,
    refused: Option[Refused],
    layers: Option[LayerFilm] = None,
    learned: Option[GuideOutcome] = None,
    earlier: Int = 0
):
  /** Colour channels, then AOVs, then wavelength bands. */
  def image(development: Development): Image = image(development, development(film))

  /** Likewise, if the colours are developed. */
  def image(development: Development, colors: Image): Image =
    val layered = layers.fold(colors)(_.behind(colors, development))
    development.bands.fold(layered): bands =>
      film.bands.fold(bands.behind(layered, film.toImage(1f)))(_.behind(layered))

  def isComplete: Boolean = samplesDone >= samplesPerPixel

  /** Whether no number of samples was to end it. */
  def isOpenEnded: Boolean = samplesPerPixel == RenderPlan.Endless

/** An internal error in one sample: `cause`, with its pixel and sample number. */
final class RenderFailure(val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)

/** A part of a rendering after which all pixels have the same number of samples.
  *
  * @param samples samples per pixel so far
  * @param begin   seconds since the start of rendering, without the observer's time
  * @param workers busy time of each worker, in seconds
  * @param isLast  whether it completes the rendering
  * @param isWhole whether it was not shortened by [[PassObserver.most]]
  * @param clock   seconds since the start of rendering, with the observer's time
  * @param step    fewest samples per pixel of a part; 0: the rendering may end at any time
  */
final case class Pass(
    samples: Int,
    begin: Double,
    end: Double,
    workers: Vector[Double],
    isLast: Boolean = false,
    isWhole: Boolean = true,
    clock: Double = 0,
    step: Int = 1
)

/** An image observer, called after 1, 2, 4, 8, … samples per pixel, and at the end.
  *
  * All workers pause for it, and its time is excluded, so that measurements don't slow down what
  * they measure. The pause between passes is its only cost.
  */
abstract class PassObserver:

  /** Called in the caller's thread; no sample is added meanwhile. Not called for a cancelled pass.
    */
  def passed(pass: Pass, film: Film): Unit

  /** Called before the first pass.
    *
    * @param samples samples per pixel of an earlier rendering that is continued
    */
  def begins(samples: Int, film: Film): Unit = ()

  /** Whether the image is good enough: the rendering then ends. */
  def isEnough: Boolean = false

  /** Asked about ten times a second: whether the rendering is to end at once, though not all pixels
    * have the same number of samples.
    *
    * @param seconds since the start of rendering, with the observer's time
    * @param still   seconds since a worker last got on with its work
    */
  def isOver(seconds: Double, still: Double): Boolean = false

  /** Whether it is also called in between, after each part of which every pixel gets equally many
    * samples, up to 64.
    */
  def seesWaves: Boolean = false

  /** How many samples per pixel to take at most before it is called again, if it sees waves. */
  def most: Int = Int.MaxValue

  /** What it expects to end the rendering. */
  def goal: Option[ExpectedEnd] = None

  /** The relative error after so many samples per pixel, if it observes errors. */
  def errorAt(samples: Double): Option[Double] = None

/** What is expected to end a rendering, whichever comes first.
  *
  * @param seconds since the start of rendering, with the observer's time
  * @param samples samples per pixel, by the trend so far
  */
final case class ExpectedEnd(seconds: Option[Double], samples: Option[Double])

package candela.cli

import candela.film.Film
import candela.render.{Pass, Progress, PassObserver}

/** Ends a rendering at a time, or at an error, with a whole number of samples in every pixel.
  *
  * @param planned  samples per pixel at which it ends in any case
  * @param recorder measures the error
  */
final class Goal(options: FilmOptions, planned: Int, recorder: RenderRecorder) extends PassObserver:
  private var isReached = false
  private var earlier, seen = 0

  override def isEnough: Boolean = isReached
  override def seesWaves: Boolean = true

  override def begins(samples: Int, film: Film): Unit =
    earlier = samples
    seen = samples
    recorder.begins(samples, film)

  def passed(pass: Pass, film: Film): Unit =
    recorder.passed(pass, film)
    val isKnown = pass.samples >= Goal.Fewest
    val error = recorder.errorAt(pass.samples).filter(_ => isKnown)
    if options.error.exists(most => error.exists(_ <= most)) then isReached = true
    // The nearest end: half of the next part would take it past the time
    val perSample = (pass.end - pass.begin) / Math.max(1, pass.samples - seen)
    if options.time.exists(_ <= pass.end + perSample * pass.next / 2) then isReached = true
    seen = pass.samples

  /** What is known about the end: the first of the planned samples, the time, and the error. */
  def outlook(progress: Progress): Outlook =
    val perSample = progress.total.toDouble / Math.max(1, planned - earlier)
    val samples = earlier + progress.done / perSample
    val byError = options.error.flatMap(recorder.samplesUntil)
    val end = byError.fold(planned.toDouble)(Math.min(planned, _))
    val bySamples = Option.when(progress.done > 0):
      Math.max(0, end - samples) * perSample / progress.done * progress.seconds
    val byTime = options.time.map(t => Math.max(0, t - progress.seconds))
    val left = (bySamples ++ byTime).minOption
    Outlook(left, recorder.errorAt(samples))

object Goal:
  /** Fewer samples per pixel say little about an error. */
  val Fewest = 4

/** @param secondsLeft by the trend; none if not known
  * @param error       relative error so far
  */
final case class Outlook(secondsLeft: Option[Double], error: Option[Double])

package candela.cli

import candela.film.Film
import candela.render.{Pass, Progress, PassObserver, Rendering}

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

  /** At the time, if no sample ends any more. */
  override def isOver(seconds: Double, still: Double): Boolean =
    if options.time.exists(_ <= seconds) && still > Goal.Patience then isReached = true
    isReached

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

  /** What is missing, if the rendering ended before its goal because all samples were taken. */
  def missed(rendering: Rendering): Option[String] =
    val isEarly = options.time.forall(rendering.seconds < Goal.Nearly * _)
    Option.when(!isReached && isEarly && rendering.samplesDone >= planned):
      val time = options.time.map: asked =>
        s"the rendering ended after ${Figures.duration(rendering.seconds)}, " +
          s"not ${Figures.duration(asked)}"
      val error = options.error.map: asked =>
        val found = recorder.errorAt(rendering.samplesDone)
        val known = found.fold("not known")(e => s"${Figures.percentage(e)}")
        s"the error is $known, not ${Figures.percentage(asked)}"
      s"warning: ${(error ++ time).mkString(", and ")}: all ${Figures.count(planned, "sample")} " +
        "per pixel are taken; a larger --spp allows more"

object Goal:
  /** Of a time; what ends later was asked for. */
  private val Nearly = 0.9

  /** In seconds; longer than any sound sample takes. */
  private val Patience = 0.5

  /** Fewer samples per pixel say little about an error. */
  val Fewest = 4

/** @param secondsLeft by the trend; none if not known
  * @param error       relative error so far
  */
final case class Outlook(secondsLeft: Option[Double], error: Option[Double])

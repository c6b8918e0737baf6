package candela.cli

import candela.film.Film
import candela.render.{Pass, Witness}

/** Ends a rendering after a time, or at an error.
  *
  * @param recorder measures the errors after 1, 2, 4, 8, … samples per pixel
  */
final class Goal(options: FilmOptions, recorder: Option[RenderRecorder]) extends Witness:
  private var isReached = false

  override def isEnough: Boolean = isReached
  override def seesWaves: Boolean = options.time.isDefined

  override def begins(samples: Int, film: Film): Unit = recorder.foreach(_.begins(samples, film))

  def passed(pass: Pass, film: Film): Unit =
    for r <- recorder if pass.isLast || Integer.bitCount(pass.samples) == 1 do
      r.passed(pass, film)
      val error = r.points.lastOption.filter(_.samples == pass.samples).map(_.errors.relativeMse)
      if options.error.exists(most => error.exists(_ <= most)) then isReached = true
    if options.time.exists(_ <= pass.end) then isReached = true

package candela.job

import candela.film.{Development, Film}
import candela.render.{Looks, Pass}

/** Estimates the error that a rendering of a known number of samples has reached, from the last
  * three powers of two only. Where a look at a large image takes long, there is no estimate.
  *
  * @param planned samples per pixel
  */
final class ReachedError(development: Development, planned: Int)
    extends ErrorRecorder(development, None):
  import ReachedError.*
  private val first = Integer.highestOneBit(planned) / 4
  private var isGivenUp = false

  override def looks: Looks = Looks.Doublings

  override def begins(samples: Int, film: Film): Unit =
    isGivenUp = samples > 0
    super.begins(samples, film)

  override def passed(pass: Pass, film: Film): Unit =
    val isDue = pass.samples >= first && Integer.bitCount(pass.samples) == 1
    isGivenUp ||= takesLong(seconds, pass.clock * planned / pass.samples)
    if isDue && !isGivenUp then super.passed(pass, film)

  /** None if too little is known. */
  override def errorAt(samples: Double): Option[Double] =
    super.errorAt(samples).filter(e => !isGivenUp && samples >= Goal.MinSamples && !e.isNaN)

object ReachedError:
  /** None if too few samples are planned for an estimate. */
  def of(development: Development, planned: Int): Option[ReachedError] =
    Option.when(planned >= Goal.MinSamples)(ReachedError(development, planned))

  /** The share of a rendering that it may take, and the seconds of a short one. */
  private val MaxShare = 0.01
  private val FreeSeconds = 0.2

  /** Has it taken too much of a rendering that is expected to last so long? The first look is slow,
    * as it is compiled meanwhile, and the rendering young.
    *
    * @param spent and `whole` in seconds
    */
  private[job] def takesLong(spent: Double, whole: Double): Boolean =
    spent > FreeSeconds && spent > MaxShare * whole

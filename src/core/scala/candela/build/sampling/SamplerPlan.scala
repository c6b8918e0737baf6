package candela.build.sampling

import candela.sampling.PointSet
import candela.settings.PointChoice

/** What a Sampler statement asks for.
  *
  * @param name       of the statement's type
  * @param count      samples per pixel
  * @param own        its points, or the nearest that there are
  * @param isEven     whether it asks for evenly spread points, whose kind doesn't matter
  */
final case class SamplerPlan(
    name: String,
    count: Int,
    seed: Int,
    own: PointSet,
    isEven: Boolean = true
):
  def points(choice: PointChoice): PointSet = choice match
    case PointChoice.Best => if isEven then SamplerPlan.Best else own
    case PointChoice.Progressive =>
      if isEven || own == PointSet.ZSobol then SamplerPlan.Best else own
    case PointChoice.Scene => own
    case PointChoice.Named(points) => points

  /** The points of this choice, and why. */
  def describe(choice: PointChoice): String =
    val chosen = points(choice)
    choice match
      case PointChoice.Named(_) => s"${chosen.meaning}, by --sampler"
      case PointChoice.Best | PointChoice.Progressive if isEven && chosen != own =>
        s"${chosen.meaning}, which have less noise than \"$name\" (--sampler scene takes " +
          s"${own.meaning})"
      case PointChoice.Progressive if chosen != own =>
        s"${chosen.meaning}, any number of which are evenly spread, unlike those of \"$name\""
      case _ => s"${chosen.meaning}, for \"$name\""

object SamplerPlan:
  /** The points with the least noise, see docs/SAMPLERS.md. */
  val Best: PointSet = PointSet.Sobol

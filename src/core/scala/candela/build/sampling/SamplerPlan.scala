package candela.build.sampling

import candela.sampling.PointSet
import candela.settings.PointChoice

/** What a Sampler statement asks for.
  *
  * @param name       of the statement's type
  * @param count      samples per pixel
  * @param own        its points, or the nearest that there are
  * @param isEven     whether it asks for evenly spread points, whose kind doesn't matter
  * @param first      whether a pixel needs all samples, if it doesn't always
  */
final case class SamplerPlan(
    name: String,
    count: Int,
    seed: Int,
    own: PointSet,
    isEven: Boolean = true,
    first: Option[FirstSampling] = None
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

/** Which pixels need `maxSamples`: those whose first samples differ, by shape or by contrast. */
final case class FirstSampling(minSamples: Int, maxSamples: Int, byShape: Boolean):

  /** pbrt-v2 exchanges the numbers if the second is less, rounds them up to powers of two, the
    * first to two at least, and doubles the second if they are the same.
    */
  def asInPbrt: FirstSampling =
    def power(n: Int) = Integer.highestOneBit(Math.max(2, n) * 2 - 1)
    val first = power(Math.min(minSamples, maxSamples))
    val all = power(Math.max(minSamples, maxSamples))
    copy(first, if first == all then 2 * all else all)

  def describe: String =
    val difference = if byShape then "see several shapes" else "contrast"
    s"$maxSamples samples in pixels whose first $minSamples $difference, otherwise these"

object SamplerPlan:
  /** The points with the least noise, see docs/SAMPLERS.md. */
  val Best: PointSet = PointSet.Sobol

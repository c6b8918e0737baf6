package candela.build.sampling

import candela.sampling.*

/** The sets of sample points that can be rendered with.
  *
  * @param word    its name on the command line
  * @param meaning its name in messages
  */
enum PointSet(val word: String, val meaning: String):
  case Independent extends PointSet("independent", "independent random numbers")
  case Stratified(grid: Option[Strata] = None)
      extends PointSet("stratified", "stratified (jittered) samples")
  case Halton extends PointSet("halton", "scrambled Halton points")
  case Sobol extends PointSet("sobol", "scrambled Sobol' points")
  case ZSobol extends PointSet("zsobol", "scrambled Sobol' points along a space-filling curve")

  /** The most samples per pixel that it can place. */
  def most: Int = this match
    case ZSobol => ZSobolSampler.MaxSamples
    case _ => Int.MaxValue

  /** @param count samples per pixel, at most `most`; some sets round it up */
  def sampler(count: Int, seed: Int, width: Int, height: Int): Sampler = this match
    case Independent => IndependentSampler(count, seed)
    case Stratified(grid) =>
      val Strata(x, y, jitter) = grid.getOrElse(Strata.square(count))
      StratifiedSampler(x, y, jitter, seed)
    case Halton => HaltonSampler(count, seed)
    case Sobol => OwenSobolSampler(count, seed)
    case ZSobol => ZSobolSampler(count, width, height, seed)

object PointSet:
  val all: Vector[PointSet] = Vector(Independent, Stratified(), Halton, Sobol, ZSobol)

/** A grid of cells in a pixel. */
final case class Strata(x: Int, y: Int, jitter: Boolean = true)

object Strata:
  /** The most nearly square grid of `count` cells. */
  def square(count: Int, jitter: Boolean = true): Strata =
    val side = (1 to Math.sqrt(count.toDouble).toInt).filter(count % _ == 0).max
    Strata(count / side, side, jitter)

/** Which points to render with.
  *
  *   - `Best`: the scene's, or [[SamplerPlan.Best]] where it asks for evenly spread points of any
  *     kind
  *   - `Progressive`: likewise, but points whose number is fixed in advance are replaced, too
  *   - `Scene`: the scene's
  *   - `Named`: these
  */
enum PointChoice:
  case Best, Progressive, Scene
  case Named(points: PointSet)

  def word: String = this match
    case Best => "best"
    case Progressive => "progressive"
    case Scene => "scene"
    case Named(points) => points.word

object PointChoice:
  val all: Vector[PointChoice] = Vector(Best, Progressive, Scene) ++ PointSet.all.map(Named(_))

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
    val taken = points(choice)
    choice match
      case PointChoice.Named(_) => s"${taken.meaning}, by --sampler"
      case PointChoice.Best | PointChoice.Progressive if isEven && taken != own =>
        s"${taken.meaning}, which have less noise than \"$name\" (--sampler scene takes " +
          s"${own.meaning})"
      case PointChoice.Progressive if taken != own =>
        s"${taken.meaning}, any number of which are evenly spread, unlike those of \"$name\""
      case _ => s"${taken.meaning}, for \"$name\""

object SamplerPlan:
  /** The points with the least noise, see docs/SAMPLERS.md. */
  val Best: PointSet = PointSet.Sobol

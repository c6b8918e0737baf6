package candela.sampling

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
  def maxSamples: Int = this match
    case ZSobol => ZSobolSampler.MaxSamples
    case _ => Int.MaxValue

  /** @param count samples per pixel, at most `maxSamples`; some sets round it up */
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

package candela.build.sampling

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.sampling.{PointSet, Strata}
import candela.scenefile.Dialect

/** Independent random samples. In pbrt's scenes somebody has chosen them; Mitsuba's have them where
  * they name no other sampler, and the best points serve as well.
  */
final class IndependentRecipe(name: String, dialects: Set[Dialect])
    extends SamplerRecipe(name, "independent random samples", dialects, default = 4):
  protected def create()(using site: Site): SamplerRequest => SamplerPlan =
    samplerPlan(PointSet.Independent, isEven = site.rules.defaultsToIndependent)

/** Scrambled (0,2)-sequences, for all samplers of this kind. */
class ScrambledSobolRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends SamplerRecipe(name, meaning, dialects):
  if name == "sobol" || name == "paddedsobol" then
    noMeaning("Owen scrambling is always used")(
      string(
        "randomization",
        "scrambling: none, permutedigits, fastowen or owen",
        onlyV4
      )("fastowen")
    )
  if name == "02sequence" || name == "lowdiscrepancy" || name == "maxmindist" then
    noMeaning("all dimensions are equally well sampled")(
      integer("dimensions", "well-sampled dimensions", onlyV3)(4)
    )

  protected def create()(using site: Site): SamplerRequest => SamplerPlan =
    samplerPlan(PointSet.Sobol)

/** Samplers replaced by scrambled Sobol' points. */
final class SubstitutedRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends ScrambledSobolRecipe(name, meaning, dialects):
  override def substitute: Option[String] =
    Some("using scrambled Sobol' points, which are at least as uniform")

/** Keeps its own points: they have no more noise than others, and it is blue. */
object ZSobolRecipe
    extends SamplerRecipe("zsobol", "Sobol' points along a space-filling curve", onlyV4):
  noMeaning("Owen scrambling is always used")(
    string("randomization", "scrambling: none, permutedigits, fastowen or owen")("fastowen")
  )
  protected def create()(using Site): SamplerRequest => SamplerPlan =
    samplerPlan(PointSet.ZSobol, isEven = false)

object HaltonRecipe extends SamplerRecipe("halton", "Halton points"):
  noMeaning("digits are always scrambled")(
    string("randomization", "scrambling: none, permutedigits or owen", onlyV4)("permutedigits")
  )
  unsupported("samples cover the whole pixel, as those of all other samplers")(
    bool("samplepixelcenter", "place all samples at the pixel centre", onlyV3)(false)
  )
  protected def create()(using Site): SamplerRequest => SamplerPlan = samplerPlan(PointSet.Halton)

object StratifiedRecipe
    extends Recipe[SamplerRequest => SamplerPlan]("stratified", "stratified (jittered) samples"):
  private val x =
    integer("xsamples", "strata along x", range = Range.atLeast(1f).limited)(if v2 then 2 else 4)
  private val y =
    integer("ysamples", "strata along y", range = Range.atLeast(1f).limited)(if v2 then 2 else 4)
  private val jitter = bool("jitter", "jitter samples in strata; otherwise at their centres")(true)
  private val seed = integer("seed", "random seed", onlyV4, shown = "the option's")(0)
  noMeaning("all dimensions are equally well sampled")(
    integer("dimensions", "well-sampled dimensions", onlyV3)(4)
  )
  protected def create()(using site: Site): SamplerRequest => SamplerPlan =
    val strata = Strata(x(), y(), jitter())
    val fixed =
      if strata.x.toLong * strata.y <= Int.MaxValue then strata
      else
        site.error(
          Code.ParameterValue,
          s"`xsamples` × `ysamples` must be at most ${Int.MaxValue} samples per pixel, found " +
            s"${strata.x} × ${strata.y}"
        )
        strata.copy(x = 1, y = 1)
    val s = seed()
    request =>
      val grid = request.spp.fold(fixed)(Strata.square(_, fixed.jitter))
      val count = Math.multiplyExact(grid.x, grid.y)
      val points = PointSet.Stratified(Some(grid))
      // Without jitter, the pattern itself is asked for
      SamplerPlan(name, count, request.seed ^ s, points, isEven = grid.jitter)

/** v2's adaptive sampler, which takes more samples where neighbours differ. */
object AdaptiveRecipe
    extends Recipe[SamplerRequest => SamplerPlan](
      "adaptive",
      "adaptive sampling by contrast or shape",
      onlyV2
    ):
  private val Samples = Range(1f, 1 << 29).limited
  private val maximum = integer("maxsamples", "maximum samples per pixel", range = Samples)(32)
  private val minimum = integer("minsamples", "minimum samples per pixel", range = Samples)(4)
  declare(
    string("method", "criterion: contrast, shapeid")("contrast")
  )
  override def substitute: Option[String] =
    Some("taking `maxsamples` in every pixel, also where `minsamples` agree and pbrt-v2 stops")

  /** Samples of a pixel in which the first ones differ. pbrt-v2 rounds both numbers up to powers of
    * two, takes the larger one, and doubles it if they are the same.
    */
  private def maxSamples()(using Site): Int =
    def power(n: Int) = Integer.highestOneBit(Math.max(2, n) * 2 - 1)
    val (a, b) = (power(minimum()), power(maximum()))
    if a == b then 2 * a else Math.max(a, b)

  protected def create()(using Site): SamplerRequest => SamplerPlan =
    val n = maxSamples()
    request => SamplerPlan(name, request.spp.getOrElse(n), request.seed, PointSet.Sobol)

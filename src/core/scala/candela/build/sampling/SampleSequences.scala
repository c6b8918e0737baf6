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

/** v2's adaptive sampler, which takes more samples of a pixel if the first ones differ. */
object AdaptiveRecipe
    extends Recipe[SamplerRequest => SamplerPlan](
      "adaptive",
      "a few samples of each pixel, or more instead where these differ: what is rare counts too " +
        "little, as in pbrt-v2; with --spp, --error or --time the same number everywhere",
      onlyV2
    ):
  private val Samples = Range(1f, 1 << 21).limited
  private val maximum =
    integer("maxsamples", "samples of a pixel whose first ones differ", range = Samples)(32)
  private val minimum =
    integer("minsamples", "first samples of each pixel", range = Samples)(4)
  private val method = oneOf("method", "what must differ", Seq("contrast", "shapeid"))("contrast")

  protected def create()(using Site): SamplerRequest => SamplerPlan =
    val first = FirstSampling(minimum(), maximum(), method() == "shapeid")
    request =>
      val samples = request.spp.getOrElse(first.asInPbrt.maxSamples)
      val adaptive = Option.when(request.spp.isEmpty)(first)
      SamplerPlan(name, samples, request.seed, PointSet.Sobol, first = adaptive)

package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.*
import candela.scenefile.Dialect

/** Samples that know nothing of each other. */
final class IndependentRecipe(name: String, dialects: Set[Dialect])
    extends SamplerRecipe(name, "independent random samples", dialects, default = 4):
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => IndependentSampler(count(request), request.seed ^ s)

/** Scrambled (0,2)-sequences, under the many names of such samplers. */
class ScrambledSobolRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends SamplerRecipe(name, meaning, dialects):
  if name == "sobol" || name == "paddedsobol" then
    noMeaning("Owen's scrambling is always used")(
      string("randomization", "none, permutedigits, fastowen or owen", onlyV4)("fastowen")
    )
  if name == "02sequence" || name == "lowdiscrepancy" || name == "maxmindist" then
    noMeaning("all dimensions are sampled alike")(
      integer("dimensions", "dimensions with good samples", onlyV3)(4)
    )

  protected def make()(using site: Site): SamplerRequest => Sampler =
    val s = seed()
    request => OwenSobolSampler(count(request), request.seed ^ s)

/** Points for which scrambled Sobol' points stand in. */
final class SubstitutedRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends ScrambledSobolRecipe(name, meaning, dialects):
  override protected def make()(using site: Site): SamplerRequest => Sampler =
    site.warn(s"sampler \"$name\": scrambled Sobol' points are used, which are at least as even")
    super.make()

object ZSobolRecipe
    extends SamplerRecipe("zsobol", "Sobol' points along a space-filling curve", onlyV4):
  noMeaning("Owen's scrambling is always used")(
    string("randomization", "none, permutedigits, fastowen or owen")("fastowen")
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => ZSobolSampler(count(request), request.width, request.height, request.seed ^ s)

object HaltonRecipe extends SamplerRecipe("halton", "Halton points"):
  noMeaning("digits are always scrambled")(
    string("randomization", "none, permutedigits or owen", onlyV4)("permutedigits")
  )
  notYet("samples lie all over the pixel")(
    bool("samplepixelcenter", "all samples in the pixel's middle", onlyV3)(false)
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => HaltonSampler(count(request), request.seed ^ s)

object StratifiedRecipe
    extends Recipe[SamplerRequest => Sampler]("stratified", "one sample in each cell of a grid"):
  private val x = integer("xsamples", "strata along x")(if v2 then 2 else 4)
  private val y = integer("ysamples", "strata along y")(if v2 then 2 else 4)
  private val jitter = bool("jitter", "a random place in each stratum, or its middle")(true)
  private val seed = integer("seed", "of the random numbers", onlyV4, shown = "the option's")(0)
  noMeaning("all dimensions are sampled alike")(
    integer("dimensions", "dimensions with good samples", onlyV3)(4)
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val (nx, ny, j, s) = (Math.max(1, x()), Math.max(1, y()), jitter(), seed())
    request =>
      // Another count is split into the most nearly square strata
      val (a, b) = request.spp.fold((nx, ny)): n =>
        val side = (1 to Math.sqrt(n.toDouble).toInt).filter(n % _ == 0).max
        (n / side, side)
      StratifiedSampler(a, b, j, request.seed ^ s)

/** v2's sampler that takes more samples where neighbours differ. */
object AdaptiveRecipe
    extends Recipe[SamplerRequest => Sampler]("adaptive", "more samples where it matters", onlyV2):
  private val most = integer("maxsamples", "samples of a pixel where it matters")(32)
  declare(
    integer("minsamples", "samples of every pixel")(4),
    string("method", "what decides: contrast, shapeid")("contrast")
  )
  override def pending: Option[String] = Some("`maxsamples` are taken in every pixel")
  protected def make()(using Site): SamplerRequest => Sampler =
    val n = most()
    request => OwenSobolSampler(request.spp.getOrElse(n), request.seed)

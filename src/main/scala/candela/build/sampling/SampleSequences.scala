package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.*
import candela.scenefile.Dialect

/** Independent random samples. */
final class IndependentRecipe(name: String, dialects: Set[Dialect])
    extends SamplerRecipe(name, "independent random samples", dialects, default = 4):
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => IndependentSampler(count(request), request.seed ^ s)

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

  protected def make()(using site: Site): SamplerRequest => Sampler =
    val s = seed()
    request => OwenSobolSampler(count(request), request.seed ^ s)

/** Samplers replaced by scrambled Sobol' points. */
final class SubstitutedRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends ScrambledSobolRecipe(name, meaning, dialects):
  override protected def make()(using site: Site): SamplerRequest => Sampler =
    site.warn(
      s"sampler \"$name\" is not supported; using scrambled Sobol' points, which are at least as " +
        "uniform"
    )
    super.make()

object ZSobolRecipe
    extends SamplerRecipe("zsobol", "Sobol' points along a space-filling curve", onlyV4):
  noMeaning("Owen scrambling is always used")(
    string("randomization", "scrambling: none, permutedigits, fastowen or owen")("fastowen")
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => ZSobolSampler(count(request), request.width, request.height, request.seed ^ s)

object HaltonRecipe extends SamplerRecipe("halton", "Halton points"):
  noMeaning("digits are always scrambled")(
    string("randomization", "scrambling: none, permutedigits or owen", onlyV4)("permutedigits")
  )
  notYet("samples cover the whole pixel")(
    bool("samplepixelcenter", "place all samples at the pixel centre", onlyV3)(false)
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val s = seed()
    request => HaltonSampler(count(request), request.seed ^ s)

object StratifiedRecipe
    extends Recipe[SamplerRequest => Sampler]("stratified", "stratified (jittered) samples"):
  private val x = integer("xsamples", "strata along x")(if v2 then 2 else 4)
  private val y = integer("ysamples", "strata along y")(if v2 then 2 else 4)
  private val jitter = bool("jitter", "jitter samples in strata; otherwise at their centres")(true)
  private val seed = integer("seed", "random seed", onlyV4, shown = "the option's")(0)
  noMeaning("all dimensions are equally well sampled")(
    integer("dimensions", "well-sampled dimensions", onlyV3)(4)
  )
  protected def make()(using Site): SamplerRequest => Sampler =
    val (nx, ny, j, s) = (Math.max(1, x()), Math.max(1, y()), jitter(), seed())
    request =>
      // Other counts use the most nearly square strata
      val (a, b) = request.spp.fold((nx, ny)): n =>
        val side = (1 to Math.sqrt(n.toDouble).toInt).filter(n % _ == 0).max
        (n / side, side)
      StratifiedSampler(a, b, j, request.seed ^ s)

/** v2's adaptive sampler, which takes more samples where neighbours differ. */
object AdaptiveRecipe
    extends Recipe[SamplerRequest => Sampler](
      "adaptive",
      "adaptive sampling by contrast or shape",
      onlyV2
    ):
  private val most = integer("maxsamples", "maximum samples per pixel")(32)
  declare(
    integer("minsamples", "minimum samples per pixel")(4),
    string("method", "criterion: contrast, shapeid")("contrast")
  )
  override def pending: Option[String] =
    Some("using `maxsamples` in every pixel, the most that it would take")
  protected def make()(using Site): SamplerRequest => Sampler =
    val n = most()
    request => OwenSobolSampler(request.spp.getOrElse(n), request.seed)

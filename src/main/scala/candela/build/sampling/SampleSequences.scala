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

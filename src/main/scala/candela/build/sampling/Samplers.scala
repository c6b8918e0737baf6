package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.*

/** What a sampler is made for. */
final case class SamplerRequest(spp: Option[Int], seed: Int, width: Int, height: Int)

/** Recipes of samplers. */
object Samplers:
  val all: Recipes[SamplerRequest => Sampler] = Recipes(
    "sampler",
    Vector(
      IndependentRecipe("independent", onlyV4),
      IndependentRecipe("random", untilV3),
      StratifiedRecipe,
      HaltonRecipe,
      ScrambledSobolRecipe("sobol", "Sobol' points, scrambled", sinceV3),
      ScrambledSobolRecipe(
        "paddedsobol",
        "Sobol' points in pairs of dimensions, scrambled",
        onlyV4
      ),
      ZSobolRecipe,
      ScrambledSobolRecipe("lowdiscrepancy", "(0,2)-sequences, scrambled", untilV3),
      ScrambledSobolRecipe("02sequence", "(0,2)-sequences, scrambled", onlyV3),
      SubstitutedRecipe("bestcandidate", "points that keep their distance", onlyV2),
      SubstitutedRecipe("maxmindist", "points that keep their distance", onlyV3),
      SubstitutedRecipe("pmj02bn", "multi-jittered points with blue noise", onlyV4),
      AdaptiveRecipe
    )
  )

package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.PointSet
import candela.scenefile.Dialect

/** What the command line and the integrator ask of samplers. */
final case class SamplerRequest(spp: Option[Int], seed: Int)

/** Recipes of samplers. */
object Samplers:
  val all: Recipes[SamplerRequest => SamplerPlan] = Recipes(
    "sampler",
    Vector(
      IndependentRecipe("independent", onlyV4),
      IndependentRecipe("random", untilV3),
      StratifiedRecipe,
      HaltonRecipe,
      ScrambledSobolRecipe("sobol", "scrambled Sobol' points", sinceV3),
      ScrambledSobolRecipe(
        "paddedsobol",
        "scrambled Sobol' points in pairs of dimensions",
        onlyV4
      ),
      ZSobolRecipe,
      ScrambledSobolRecipe("lowdiscrepancy", "scrambled (0,2)-sequences", untilV3),
      ScrambledSobolRecipe("02sequence", "scrambled (0,2)-sequences", onlyV3),
      SubstitutedRecipe("bestcandidate", "points with a minimum distance", onlyV2),
      SubstitutedRecipe("maxmindist", "points with a minimum distance", onlyV3),
      SubstitutedRecipe("pmj02bn", "multi-jittered points with blue noise", onlyV4),
      AdaptiveRecipe
    )
  )

/** Base of samplers with a number of samples per pixel. */
abstract class SamplerRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect] = every,
    default: Int = 16
) extends Recipe[SamplerRequest => SamplerPlan](name, meaning, dialects):
  private val samples =
    integer("pixelsamples", "samples per pixel", range = Range.atLeast(1f))(if v2 then 4
    else default)
  private val seed = integer("seed", "random seed", onlyV4, shown = "the option's")(0)

  protected def samplerPlan(points: PointSet, isEven: Boolean = true)(using
      Site
  ): SamplerRequest => SamplerPlan =
    val s = seed()
    request => SamplerPlan(name, count(request), request.seed ^ s, points, isEven)

  private def count(request: SamplerRequest)(using Site): Int =
    request.spp.getOrElse(samples())

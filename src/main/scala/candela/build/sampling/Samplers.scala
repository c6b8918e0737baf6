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
      Independent("independent", onlyV4),
      Independent("random", untilV3),
      Stratified,
      Halton,
      ScrambledSobol("sobol", "Sobol' points, scrambled", sinceV3),
      ScrambledSobol("paddedsobol", "Sobol' points in pairs of dimensions, scrambled", onlyV4),
      ZSobol,
      ScrambledSobol("lowdiscrepancy", "(0,2)-sequences, scrambled", untilV3),
      ScrambledSobol("02sequence", "(0,2)-sequences, scrambled", onlyV3),
      Substituted("bestcandidate", "points that keep their distance", onlyV2),
      Substituted("maxmindist", "points that keep their distance", onlyV3),
      Substituted("pmj02bn", "multi-jittered points with blue noise", onlyV4),
      Adaptive
    )
  )

package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.Sampler
import candela.scenefile.Dialect

/** What samplers have that take a number of samples. */
abstract class SamplerRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect] = every,
    default: Int = 16
) extends Recipe[SamplerRequest => Sampler](name, meaning, dialects):
  private val samples = integer("pixelsamples", "samples per pixel")(if v2 then 4 else default)
  protected val seed: Field[Int] =
    integer("seed", "of the random numbers", onlyV4, shown = "the option's")(0)

  protected def count(request: SamplerRequest)(using site: Site): Int =
    request.spp.getOrElse:
      val n = samples()
      if n < 1 then site.error(s"`pixelsamples` must be at least 1; found $n")
      Math.max(1, n)

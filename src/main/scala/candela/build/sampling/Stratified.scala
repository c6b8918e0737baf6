package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.*

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

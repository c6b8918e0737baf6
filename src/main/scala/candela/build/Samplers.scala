package candela.build

import candela.sampling.*

/** What a sampler is made for. */
final case class SamplerRequest(spp: Option[Int], seed: Int, width: Int, height: Int)

/** Recipes of samplers. */
object Samplers:
  private val sobolNames = Vector(
    "lowdiscrepancy", "02sequence", "sobol", "paddedsobol", "bestcandidate", "pmj02bn",
    "maxmindist", "adaptive"
  )

  val all: Recipes[SamplerRequest => Sampler] = Recipes(
    "sampler",
    Vector("independent", "random").map(Independent(_)) ++ sobolNames.map(Sobol(_)) ++
      Vector(ZSobol, Halton, Stratified)
  )

  abstract class SamplerRecipe(name: String, default: Int = 16)
      extends Recipe[SamplerRequest => Sampler](name):
    private val samples =
      integer("pixelsamples", "samples per pixel")(if v2 then 4 else default)
    irrelevant("randomization", "dimensions", "samplepixelcenter")
    protected val seed = integer("seed", "of the random numbers", onlyV4)(0)

    protected def count(request: SamplerRequest)(using site: Site): Int =
      request.spp.getOrElse:
        val n = samples()
        if n < 1 then site.error(s"`pixelsamples` must be at least 1; found $n")
        Math.max(1, n)

  final class Independent(name: String) extends SamplerRecipe(name, default = 4):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => IndependentSampler(count(request), request.seed ^ s)

  /** Scrambled (0,2)-sequences, under the many names of such samplers. */
  final class Sobol(name: String) extends SamplerRecipe(name):
    private val most = integer("maxsamples", "samples per pixel of \"adaptive\"")(32)
    irrelevant("minsamples", "method")
    protected def make()(using site: Site): SamplerRequest => Sampler =
      if Set("bestcandidate", "pmj02bn", "maxmindist")(name) then
        site.warn(
          s"sampler \"$name\": scrambled Sobol' points are used, which are at least as even"
        )
      if name == "adaptive" then
        site.warn(
          s"sampler \"adaptive\" is not supported yet; ${most()} samples are taken in every pixel"
        )
      val s = seed()
      request =>
        val n = if name == "adaptive" then request.spp.getOrElse(most()) else count(request)
        OwenSobolSampler(n, request.seed ^ s)

  object ZSobol extends SamplerRecipe("zsobol"):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => ZSobolSampler(count(request), request.width, request.height, request.seed ^ s)

  object Halton extends SamplerRecipe("halton"):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => HaltonSampler(count(request), request.seed ^ s)

  object Stratified extends Recipe[SamplerRequest => Sampler]("stratified"):
    private val x = integer("xsamples", "strata along x")(if v2 then 2 else 4)
    private val y = integer("ysamples", "strata along y")(if v2 then 2 else 4)
    private val jitter = bool("jitter", "a random place in each stratum, or its middle")(true)
    private val seed = integer("seed", "of the random numbers", onlyV4)(0)
    irrelevant("dimensions")
    protected def make()(using Site): SamplerRequest => Sampler =
      val (nx, ny, j, s) = (Math.max(1, x()), Math.max(1, y()), jitter(), seed())
      request =>
        // Another count is split into the most nearly square strata
        val (a, b) = request.spp.fold((nx, ny)): n =>
          val side = (1 to Math.sqrt(n.toDouble).toInt).filter(n % _ == 0).max
          (n / side, side)
        StratifiedSampler(a, b, j, request.seed ^ s)

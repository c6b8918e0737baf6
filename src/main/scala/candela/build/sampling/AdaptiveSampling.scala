package candela.build.sampling

import candela.build.recipe.*
import candela.sampling.*

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

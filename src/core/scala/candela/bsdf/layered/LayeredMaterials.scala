package candela.bsdf.layered

import candela.bsdf.{Bsdf, Lambert, Material, TabulatedReflectance, WrappedBsdf, WrappedMaterial}
import candela.bsdf.microfacet.{Conductor, MetalTexture, Mirror, Roughness, TrowbridgeReitz}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{FloatTexture, RgbTexture, Textured, Varying}

/** The medium between base and interface of a [[Layered]] surface.
  *
  * @param thickness in mean free paths; clamped to ≥ 0
  * @param albedo    single-scattering albedo, clamped to [0, 1]
  * @param asymmetry of the phase function
  * @param maxDepth  see [[Layers]]
  * @param walks     see [[Layers]]
  */
final class LayerMedium(
    val thickness: FloatTexture,
    val albedo: RgbTexture,
    val asymmetry: FloatTexture,
    val maxDepth: Int,
    val walks: Int
) extends Textured(thickness, albedo, asymmetry):

  /** Largest number of reflections at the base, if the medium does not scatter: events alternate,
    * starting at the base.
    */
  def baseHits: Int = (maxDepth + 1) / 2

  /** The same for sampled directions: in PBRT 4, leaving the layers is an event of their paths, but
    * not of evaluated ones.
    */
  def sampledBaseHits: Int = maxDepth / 2

  /** The layers over `base`; by default without a glossy lobe. */
  private[bsdf] def layers(
      top: TrowbridgeReitz,
      eta: Float,
      base: Bsdf,
      at: ShadingPoint,
      gloss: TrowbridgeReitz = LayerMedium.NoGloss,
      share: Float = 0f
  ): Layers = Layers(
    top,
    eta,
    base,
    Math.max(thickness(at), 0f),
    albedo.albedo(at),
    asymmetry(at),
    maxDepth,
    Math.max(walks, 1),
    gloss,
    share
  )

object LayerMedium:
  private[bsdf] val NoGloss = TrowbridgeReitz(1f, 1f)

/** The layers at each surface point. */
abstract class LayersTexture extends Varying:
  def apply(at: ShadingPoint): Layers

/** Layers with a diffuse base; `reflectance` is clamped to [0, 1]. */
final class DiffuseLayers(
    reflectance: RgbTexture,
    top: Roughness,
    eta: Float,
    medium: LayerMedium
) extends LayersTexture,
      Textured(reflectance, top, medium):
  def apply(at: ShadingPoint): Layers =
    medium.layers(top.trowbridgeReitz(at), eta, Lambert(reflectance.albedo(at)), at)

/** Layers with a metal base.
  *
  * @param metal reflectance from within the coat
  */
final class ConductorLayers(
    metal: MetalTexture,
    bottom: Roughness,
    top: Roughness,
    eta: Float,
    medium: LayerMedium
) extends LayersTexture,
      Textured(metal, bottom, top, medium):
  private val share = if medium.albedo.constant.exists(_.isBlack) then 0.85f else 0.5f

  def apply(at: ShadingPoint): Layers =
    val gloss = bottom.trowbridgeReitz(at)
    val base = Conductor(gloss, metal(at))
    medium.layers(top.trowbridgeReitz(at), eta, base, at, gloss, share)

/** A layered surface evaluated by random walks. Seeds vary by position, so the material is never
  * constant.
  */
final class LayeredMaterial(layers: LayersTexture) extends Material:
  private val fixed: Layers | Null = if layers.isConstant then layers(ShadingPoint()) else null

  def bsdf(at: ShadingPoint): Layered =
    val constant = fixed
    Layered(if constant != null then constant else layers(at), Layered.hash(0L, at.p))

  override def isAnisotropic: Boolean = layers.isAnisotropic

/** A smooth metal under a smooth coat, a perfect mirror in sum; if regularised, it is evaluated by
  * random walks.
  *
  * @param mirror closed form of all interreflection
  * @param walked the same layers
  */
final class SummedConductorMaterial(mirror: Mirror, walked: LayeredMaterial)
    extends WrappedMaterial(walked):
  def bsdf(at: ShadingPoint): Bsdf = SummedLayers(mirror, walked.bsdf(at))

private final class SummedLayers(mirror: Mirror, walked: Layered) extends WrappedBsdf(mirror):
  override def regularized: Bsdf = walked.regularized

object CoatedConductorMaterial:

  /** A coated conductor: closed form if both interfaces are smooth and it is known, else random
    * walks.
    *
    * @param metal    reflectance from within the coat
    * @param mirrored reflectance of a smooth metal under a smooth coat by cosine, if known
    */
  def apply(
      metal: MetalTexture,
      bottom: Roughness,
      top: Roughness,
      eta: Float,
      medium: LayerMedium,
      mirrored: Option[Float => Rgb]
  ): Material =
    val walked = LayeredMaterial(ConductorLayers(metal, bottom, top, eta, medium))
    val isSmooth = bottom.isSmooth && (top.isSmooth || (top.isConstant && eta == 1f))
    mirrored.filter(_ => isSmooth) match
      case Some(curve) =>
        SummedConductorMaterial(Mirror(Rgb.White, TabulatedReflectance(256, curve)), walked)
      case None => walked

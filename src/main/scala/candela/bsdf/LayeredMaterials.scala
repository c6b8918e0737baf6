package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture}

/** What is between the base of a [[Layered]] surface and its interface.
  *
  * @param thickness  in mean free paths; held to be ≥ 0
  * @param albedo     held to [0, 1]
  * @param asymmetry  of scattering
  * @param maxDepth   see [[Layers]]
  * @param walks      see [[Layers]]
  */
final class LayerMedium(
    val thickness: FloatTexture,
    val albedo: RgbTexture,
    val asymmetry: FloatTexture,
    val maxDepth: Int,
    val walks: Int
):
  def isConstant: Boolean =
    thickness.constant.isDefined && albedo.constant.isDefined && asymmetry.constant.isDefined

  /** Over a diffuse base. */
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
    albedo(at).map(c => clamp(c, 0f, 1f)),
    asymmetry(at),
    maxDepth,
    Math.max(walks, 1),
    gloss,
    share
  )

object LayerMedium:
  private[bsdf] val NoGloss = TrowbridgeReitz(1f, 1f)

/** A surface whose layers are walked: at each point with random numbers of its own.
  *
  * @param isSame are the layers the same everywhere?
  */
abstract class LayeredMaterial(isSame: Boolean) extends Material:
  protected def layers(at: ShadingPoint): Layers

  // Only layers that are the same everywhere are read from here
  private lazy val fixed: Layers = layers(ShadingPoint())

  final def bsdf(at: ShadingPoint): Bsdf =
    Layered(if isSame then fixed else layers(at), Layered.hash(0L, at.p))

/** A diffuse base whose `reflectance` is held to [0, 1]. */
final class LayeredDiffuseMaterial(
    reflectance: RgbTexture,
    top: Roughness,
    eta: Float,
    medium: LayerMedium
) extends LayeredMaterial(
      reflectance.constant.isDefined && top.isConstant && medium.isConstant
    ):
  protected def layers(at: ShadingPoint): Layers =
    val base = Lambert(reflectance(at).map(c => clamp(c, 0f, 1f)))
    medium.layers(top.trowbridgeReitz(at), eta, base, at)

  override def isAnisotropic: Boolean = top.isAnisotropic

/** A metal as base.
  *
  * @param metal how it reflects from within the coat
  */
final class LayeredConductorMaterial(
    metal: MetalTexture,
    bottom: Roughness,
    top: Roughness,
    eta: Float,
    medium: LayerMedium
) extends LayeredMaterial(
      metal.isConstant && bottom.isConstant && top.isConstant && medium.isConstant
    ):
  private val share = if medium.albedo.constant.exists(_.isBlack) then 0.85f else 0.5f

  protected def layers(at: ShadingPoint): Layers =
    val gloss = bottom.trowbridgeReitz(at)
    val base = Conductor(gloss, metal(at))
    medium.layers(top.trowbridgeReitz(at), eta, base, at, gloss, share)

  override def isAnisotropic: Boolean = top.isAnisotropic || bottom.isAnisotropic

/** A smooth metal under a smooth coat, which together are a mirror; regularized, they are walked.
  *
  * @param mirror all that goes back and forth between the two, summed
  * @param walked the same layers
  */
final class SummedConductorMaterial(mirror: Mirror, walked: Material) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = SummedLayers(mirror, walked.bsdf(at))

private final class SummedLayers(mirror: Mirror, walked: Bsdf) extends WrappedBsdf(mirror):
  override def regularized: Bsdf = walked.regularized
  override def atWavelength(nm: Float): Bsdf = this

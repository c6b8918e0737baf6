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

  private[bsdf] def layers(
      top: TrowbridgeReitz,
      eta: Float,
      base: Bsdf,
      at: ShadingPoint
  ): Layers = Layers(
    top,
    eta,
    base,
    Math.max(thickness(at), 0f),
    albedo(at).map(c => clamp(c, 0f, 1f)),
    asymmetry(at),
    maxDepth,
    Math.max(walks, 1)
  )

/** A surface whose layers are walked: at each point with random numbers of its own.
  *
  * @param isConstant are the layers the same everywhere?
  */
abstract class LayeredMaterial(isSame: Boolean) extends Material:

  /** The layers at a point, and the lobe and share of [[Layered]]. */
  protected def layers(at: ShadingPoint): Layers
  protected def glossy(at: ShadingPoint): TrowbridgeReitz
  protected def share: Float

  // Only layers that are the same everywhere are read from here
  private lazy val fixed: Layers = layers(ShadingPoint())
  private lazy val fixedGloss: TrowbridgeReitz = glossy(ShadingPoint())

  final def bsdf(at: ShadingPoint): Bsdf =
    val seed = Layered.hash(0L, at.p)
    if isSame then Layered(fixed, fixedGloss, share, seed)
    else Layered(layers(at), glossy(at), share, seed)

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

  protected def glossy(at: ShadingPoint): TrowbridgeReitz = LayeredMaterial.NoGloss
  protected def share: Float = 0f
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
  protected def layers(at: ShadingPoint): Layers =
    val base = Conductor(bottom.trowbridgeReitz(at), metal(at))
    medium.layers(top.trowbridgeReitz(at), eta, base, at)

  /** Seen from outside, refraction makes the lobe of the base wider by `eta`. Two passages through
    * a rough interface bend light by (eta − 1) times the slope of the facets each, which looks like
    * mirrors of half that slope.
    */
  protected def glossy(at: ShadingPoint): TrowbridgeReitz =
    val b = bottom.trowbridgeReitz(at)
    val t = top.trowbridgeReitz(at)
    def along(base: Float, interface: Float) =
      Math.min(sqrt(square(eta * base) + 0.5f * square((eta - 1f) * interface)), 1f)
    TrowbridgeReitz(along(b.alphaX, t.alphaX), along(b.alphaY, t.alphaY))

  protected def share: Float = if medium.albedo.constant.exists(_.isBlack) then 0.85f else 0.5f

  override def isAnisotropic: Boolean = top.isAnisotropic || bottom.isAnisotropic

private object LayeredMaterial:
  val NoGloss = TrowbridgeReitz(1f, 1f)

package candela.bsdf.microfacet

import candela.bsdf.{
  Bsdf, ConductorReflectance, Lobes, Material, ReflectanceCurve, StrongConductorReflectance
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{RgbTexture, Textured, Varying}

/** A metal or other opaque mirror, as rough as `distribution` says. */
object Conductor:
  def apply(
      distribution: MicrofacetDistribution,
      curve: ReflectanceCurve,
      scale: Rgb = Rgb.White
  ): Bsdf =
    if distribution.isSmooth then Mirror(scale, curve)
    else MicrofacetReflection(distribution, curve, scale)

/** A metal. */
final class ConductorMaterial(metal: MetalTexture, roughness: Roughness)
    extends Material,
      Textured(metal, roughness):
  def bsdf(at: ShadingPoint): Bsdf = Conductor(roughness(at), metal(at))

/** How a metal reflects, at each point of a surface. */
abstract class MetalTexture extends Varying:
  def apply(at: ShadingPoint): ReflectanceCurve

/** The same curve everywhere. */
final class UniformMetal(curve: ReflectanceCurve) extends MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve = curve
  def isConstant: Boolean = true

/** A metal of varying complex index of refraction.
  *
  * @param outside index of the medium that it is in
  * @param strong  by the approximation for metals that absorb well
  */
final class IndexedMetal(
    eta: RgbTexture,
    k: RgbTexture,
    outside: Float = 1f,
    strong: Boolean = false
) extends MetalTexture,
      Textured(eta, k):
  def apply(at: ShadingPoint): ReflectanceCurve =
    val n = eta(at) * (1f / outside)
    val a = k(at) * (1f / outside)
    if strong then StrongConductorReflectance(n, a) else ConductorReflectance(n, a)

/** A metal given by what it would reflect at normal incidence, were it outside.
  *
  * @param outside index of the medium that it is in
  */
final class TintedMetal(reflectance: RgbTexture, outside: Float = 1f)
    extends MetalTexture,
      Textured(reflectance):
  def apply(at: ShadingPoint): ReflectanceCurve =
    ConductorReflectance.ofReflectance(reflectance(at), outside)

/** A rough and a smooth metal on top of each other, by their reflectances at normal incidence (PBRT
  * 2's "shinymetal"): each gets the index of refraction of the dielectric that reflects as much.
  */
final class ShinyMetalMaterial(ks: RgbTexture, kr: RgbTexture, roughness: Roughness)
    extends Material,
      Textured(ks, kr, roughness):
  def bsdf(at: ShadingPoint): Bsdf =
    val gloss = ks(at)
    val mirror = kr(at)
    Lobes.Builder()
      .add(MicrofacetReflection(roughness(at), ShinyMetalMaterial.curve(gloss)), gloss.max)
      .add(Mirror(Rgb.White, ShinyMetalMaterial.curve(mirror)), mirror.max)
      .result

object ShinyMetalMaterial:
  private[bsdf] def curve(reflectance: Rgb): ReflectanceCurve =
    val eta = reflectance.map: r =>
      val root = sqrt(clamp(r, 0f, 0.999f))
      (1f + root) / (1f - root)
    StrongConductorReflectance(eta, Rgb.Black)

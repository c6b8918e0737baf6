package candela.bsdf.microfacet

import candela.bsdf.{
  Bsdf, ConductorReflectance, Lobes, Material, MaterialFlags, ReflectanceCurve,
  StrongConductorReflectance
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantRgb, RgbTexture, Textured, Varying}

/** A rough or smooth conductor, or another opaque mirror. */
object Conductor:
  def apply(
      distribution: MicrofacetDistribution,
      curve: ReflectanceCurve,
      scale: Rgb = Rgb.White
  ): Bsdf =
    if distribution.isSmooth then Mirror(scale, curve)
    else MicrofacetReflection(distribution, curve, scale)

/** A metal surface; `scale` scales its reflectance. */
final class ConductorMaterial(
    metal: MetalTexture,
    roughness: Roughness,
    scale: RgbTexture = ConstantRgb(Rgb.White)
) extends Material,
      Textured(metal, roughness, scale):
  def bsdf(at: ShadingPoint): Bsdf = Conductor(roughness(at), metal(at), scale(at))
  override def flags: MaterialFlags = roughness.flags

/** Reflectance curve of a metal at each surface point. */
abstract class MetalTexture extends Varying:
  def apply(at: ShadingPoint): ReflectanceCurve

/** A constant reflectance curve. */
final class UniformMetal(curve: ReflectanceCurve) extends MetalTexture:
  def apply(at: ShadingPoint): ReflectanceCurve = curve
  def isConstant: Boolean = true

/** A metal of textured complex index of refraction.
  *
  * @param outside index of the surrounding medium
  * @param strong  if true, uses the approximation for strongly absorbing metals
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

/** A metal given by its reflectance at normal incidence in air.
  *
  * @param outside index of the surrounding medium
  */
final class TintedMetal(reflectance: RgbTexture, outside: Float = 1f)
    extends MetalTexture,
      Textured(reflectance):
  def apply(at: ShadingPoint): ReflectanceCurve =
    ConductorReflectance.ofReflectance(reflectance(at), outside)

/** Sum of a rough and a smooth metal, given by their reflectances at normal incidence (PBRT 2's
  * "shinymetal"). Each has the index of refraction of the dielectric of equal reflectance.
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

  override def flags: MaterialFlags = MaterialFlags.Caster

object ShinyMetalMaterial:
  private[bsdf] def curve(reflectance: Rgb): ReflectanceCurve =
    val eta = reflectance.map: r =>
      val root = sqrt(clamp(r, 0f, 0.999f))
      (1f + root) / (1f - root)
    StrongConductorReflectance(eta, Rgb.Black)

package candela.bsdf.microfacet

import candela.bsdf.{
  Bounce, Bsdf, BsdfFlags, DielectricReflectance, Fresnel, FullReflectance, Hemisphere, Lambert,
  LeanBsdf, Material, MaterialFlags, ReflectanceCurve
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured}

/** Base of perfectly specular BSDFs: only `sample` can generate their directions. */
sealed abstract class Specular extends LeanBsdf:
  final def f(wo: Vec3, wi: Vec3): Rgb = Rgb.Black
  final def pdf(wo: Vec3, wi: Vec3): Float = 0f

/** A perfect mirror on both sides.
  *
  * @param scale scale of the reflectance `curve`
  */
final class Mirror(scale: Rgb, curve: ReflectanceCurve = FullReflectance) extends Specular:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val weight = scale * curve(wo.z)
    if weight.isBlack then out.absorb()
    else out.set(Hemisphere.mirrored(wo), weight, 1f, isSpecular = true)

  def flags: BsdfFlags = BsdfFlags.Specular | BsdfFlags.Narrow
  override def regularized: Bsdf =
    MicrofacetReflection(TrowbridgeReitz.RegularizedMirror, curve, scale)

/** A smooth dielectric interface.
  *
  * @param eta           index of refraction inside (below the surface) over that outside
  * @param reflectance   scale of the reflected light
  * @param transmittance scale of the refracted light
  * @param compresses    whether refraction scales radiance by the square of the index, as is
  *                      physically correct because the solid angle changes; PBRT before version 3
  *                      omits this
  */
final class SmoothDielectric(
    eta: Float,
    reflectance: Rgb = Rgb.White,
    transmittance: Rgb = Rgb.White,
    compresses: Boolean = true
) extends Specular:

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val reflected = Fresnel.dielectric(wo.z, eta)
    val reflects = reflected * reflectance.max
    val transmits = (1f - reflected) * transmittance.max
    val total = reflects + transmits
    if total <= 0f then out.absorb()
    else if choice * total < reflects then
      val weight = reflectance * (reflected * total / reflects)
      out.set(Hemisphere.mirrored(wo), weight, reflects / total, isSpecular = true)
    else refract(wo, (1f - reflected) * total / transmits, transmits / total, out)

  private def refract(wo: Vec3, weight: Float, probability: Float, out: Bounce): Unit =
    val relative = if wo.z < 0f then 1f / eta else eta
    val cosT = Fresnel.cosRefracted(Math.abs(wo.z), relative)
    // Rounding in Double and Float may place the critical angle one ulp apart.
    if cosT <= 0f then out.absorb()
    else
      // Near a cosine of 1, the sine computed from it keeps half its digits
      val x = -wo.x.toDouble / relative
      val y = -wo.y.toDouble / relative
      val sin2 = x * x + y * y
      val depth = if sin2 < 0.5 then Math.sqrt(1.0 - sin2).toFloat else cosT
      val wi = Vec3(x.toFloat, y.toFloat, if wo.z < 0f then depth else -depth).normalized
      val scale = if compresses then weight / (relative * relative) else weight
      out.set(wi, transmittance * scale, probability, isSpecular = true, eta = relative)

  val flags: BsdfFlags =
    val common = BsdfFlags.Specular | BsdfFlags.Narrow | BsdfFlags.Choosing
    if transmittance.isBlack then common else common | BsdfFlags.Transmissive

  /** Unchanged unless `compresses`: [[RoughDielectric]] always scales radiance. */
  override def regularized: Bsdf =
    if compresses then
      Dielectric(TrowbridgeReitz.RegularizedMirror, eta, reflectance, transmittance)
    else this

/** A thin dielectric slab with two parallel smooth sides, including all internal reflections.
  * Transmitted light keeps its direction.
  *
  * @param eta           index of refraction of the slab over that outside
  * @param reflectance   scale of the reflected light
  * @param transmittance scale of the transmitted light
  *
  * Source: Stokes, "On the intensity of the light reflected from or transmitted through a pile of
  * plates", Proc. Royal Society 11, 1862; PBRT 4th ed., §9.5.
  */
final class ThinDielectric(
    eta: Float,
    reflectance: Rgb = Rgb.White,
    transmittance: Rgb = Rgb.White
) extends Specular:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val probability = reflected(wo)
    if choice < probability then
      out.set(Hemisphere.mirrored(wo), reflectance, probability, isSpecular = true)
    else out.set(-wo, transmittance, 1f - probability, isSpecular = true)

  def flags: BsdfFlags =
    BsdfFlags.Specular | BsdfFlags.Narrow | BsdfFlags.Transmissive | BsdfFlags.Pane |
      BsdfFlags.Choosing

  override def straight(wo: Vec3): Rgb = transmittance * (1f - reflected(wo))

  /** The geometric series of inner reflections. */
  private def reflected(wo: Vec3): Float =
    val fresnel = Fresnel.dielectric(Math.abs(wo.z), eta)
    2f * fresnel / (1f + fresnel)

/** A thin dielectric; colours as in [[ThinDielectric]]. */
final class ThinDielectricMaterial(eta: Float, kr: RgbTexture, kt: RgbTexture)
    extends Material,
      Textured(kr, kt):
  def bsdf(at: ShadingPoint): Bsdf = ThinDielectric(eta, kr.positive(at), kt.positive(at))
  override def flags: MaterialFlags = MaterialFlags.Pane | MaterialFlags.Caster

/** Transmits a fraction of the light unscattered. */
final class Passthrough(transmittance: Rgb) extends Specular:
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    if transmittance.isBlack then out.absorb()
    else out.set(-wo, transmittance, 1f, isSpecular = true)

  def flags: BsdfFlags = BsdfFlags.Specular | BsdfFlags.Transmissive

/** A perfect mirror of constant reflectance. */
final class MirrorMaterial(kr: RgbTexture) extends Material, Textured(kr):
  def bsdf(at: ShadingPoint): Bsdf = Mirror(kr.positive(at))
  override def flags: MaterialFlags = MaterialFlags.Caster

/** Specular reflection with the Fresnel term of an interface of index `eta`, times `kr`, without
  * transmission: the surface of PBRT 2's subsurface materials.
  */
final class ReflectingInterfaceMaterial(kr: RgbTexture, eta: FloatTexture)
    extends Material,
      Textured(kr, eta):
  def bsdf(at: ShadingPoint): Bsdf =
    val scale = kr.positive(at)
    if scale.isBlack then Lambert.Black else Mirror(scale, DielectricReflectance(eta(at)))

package candela.bsdf.microfacet

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, Hemisphere, LeanBsdf, Material}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{RgbTexture, Textured}

/** A diffuse base under a glossy coat; the base receives what the coat doesn't reflect.
  *
  * Reciprocal. Each lobe is sampled with probability 1/2.
  *
  * @param diffuse  reflectance of the base, in [0, 1]
  * @param specular reflectance of the coat at normal incidence, in [0, 1]; 1 at grazing incidence
  *
  * Source: Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools
  * 5(2), 2000; with Schlick's approximation for the coat.
  */
final class FresnelBlend(diffuse: Rgb, specular: Rgb, distribution: MicrofacetDistribution)
    extends LeanBsdf:
  private val base = diffuse * (Rgb.White - specular) * (28f / (23f * Pi))
  private val absent = Rgb.White - specular

  def f(wo: Vec3, wi: Vec3): Rgb =
    if !Hemisphere.isSameSide(wo, wi) then Rgb.Black
    else reflectedAcross(Hemisphere.above(wo), Hemisphere.above(wi))

  override def reflectedAcross(wo: Vec3, wi: Vec3): Rgb =
    val (cosO, cosI) = (Hemisphere.absCos(wo), Hemisphere.absCos(wi))
    val halfVector = (wo + wi).normalized
    val cosM = wo dot halfVector
    val diffuseTerm = base * (penetration(cosO) * penetration(cosI))
    if !(cosM > 0f) then diffuseTerm
    else
      val m = halfVector.facing(Vec3.Z)
      val schlick = specular + absent * fifthPower(1f - Math.min(cosM, 1f))
      diffuseTerm + schlick * (distribution.d(m) / (4f * cosM * Math.max(cosO, cosI)))

  /** Approximate transmittance to the base at this cosine, relative to normal incidence. */
  private def penetration(cosine: Float): Float = 1f - fifthPower(1f - 0.5f * cosine)

  private def fifthPower(x: Float): Float = square(x * x) * x

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !Hemisphere.isSameSide(wo, wi) then 0f
    else
      val o = Hemisphere.above(wo)
      val m = (o + Hemisphere.above(wi)).normalized
      0.5f * (Hemisphere.cosinePdf(wi) + coatPdf(o, m))

  /** Samples normals as seen along the surface normal: [[f]] has no masking or shadowing, so
    * visible normals of `wo` would rarely match it near the horizon, and their weights would be
    * unbounded.
    */
  private def coatPdf(o: Vec3, m: Vec3): Float =
    val cosM = o dot m
    if cosM > 0f then distribution.pdf(Vec3.Z, m) / (4f * cosM) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi =
      if choice < 0.5f then Hemisphere.cosineSample(wo, u1, u2) else sampleCoat(wo, u1, u2)
    val density = pdf(wo, wi)
    if density > 0f then
      val weight = f(wo, wi) * (Hemisphere.absCos(wi) / density)
      out.set(wi, weight, density, isSpecular = false)
    else out.absorb()

  private def sampleCoat(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val o = Hemisphere.above(wo)
    val m = distribution.sample(Vec3.Z, u1, u2)
    val i = Hemisphere.reflected(o, m, o dot m)
    Hemisphere.seenFrom(wo, i)

  def flags: BsdfFlags = BsdfFlags.Glossy | BsdfFlags.Choosing
  override def regularized: Bsdf = FresnelBlend(diffuse, specular, distribution.regularized)

/** [[FresnelBlend]]; colours are clamped to ≥ 0. */
final class SubstrateMaterial(kd: RgbTexture, ks: RgbTexture, roughness: Roughness)
    extends Material,
      Textured(kd, ks, roughness):
  def bsdf(at: ShadingPoint): Bsdf = FresnelBlend(kd.positive(at), ks.positive(at), roughness(at))

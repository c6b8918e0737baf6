package candela.bsdf.microfacet

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, Hemisphere, LeanBsdf}
import candela.color.Rgb
import candela.geometry.Frame
import candela.math.*
import candela.sampling.Warp

/** The glossy lobe of the modified Phong model: a power of the cosine to the mirrored direction,
  * the same on both sides.
  *
  * @param specular  reflectance of a lobe that the horizon does not cut off, at normal incidence
  * @param exponent  at least 0; higher is smoother
  *
  * Source: Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based
  * Rendering", report CW 197, K.U. Leuven, 1994.
  */
final class PhongLobe(specular: Rgb, exponent: Float) extends LeanBsdf:
  private val value = specular * ((exponent + 2f) * InvTwoPi)
  private val density = (exponent + 1f) * InvTwoPi

  /** The power of the cosine; 0 beyond a right angle. */
  private def power(wo: Vec3, wi: Vec3): Float =
    // By the chord, which keeps the digits that a cosine near 1 loses
    val chord = wi - Hemisphere.mirrored(wo)
    val versine = 0.5 * (chord dot chord)
    if versine >= 1.0 then 0f else Math.exp(exponent * Math.log1p(-versine)).toFloat

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isSameSide(wo, wi) then value * power(wo, wi) else Rgb.Black

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isSameSide(wo, wi) then density * power(wo, wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val cosine = Math.pow(1.0 - u1, 1.0 / (exponent + 1.0))
    val sine = Math.sqrt(Math.max(0.0, 1.0 - cosine * cosine)).toFloat
    val local = Warp.spherical(cosine.toFloat, sine, u2)
    val wi = Frame.fromZ(Hemisphere.mirrored(wo)).toWorld(local)
    val p = pdf(wo, wi)
    if p <= 0f then out.absorb()
    else
      val ratio = (exponent + 2f) / (exponent + 1f)
      out.set(wi, specular * (ratio * Hemisphere.absCos(wi)), p, isSpecular = false)

  /** Roughness of microfacets that spread light as much: their normals turn half as far. */
  private def roughness: Float = sqrt(1f / (2f * exponent + 1f))

  def flags: BsdfFlags =
    if roughness < TrowbridgeReitz.Wide then BsdfFlags.Glossy | BsdfFlags.Narrow
    else BsdfFlags.Glossy

  override def regularized: Bsdf =
    val wide = TrowbridgeReitz(roughness, roughness).regularized.alphaX
    PhongLobe(specular, Math.min(exponent, 0.5f / square(wide)))

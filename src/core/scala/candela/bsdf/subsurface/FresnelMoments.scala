package candela.bsdf.subsurface

import candela.bsdf.{Bounce, BsdfFlags, Fresnel, Hemisphere, LeanBsdf}
import candela.color.Rgb
import candela.math.*

/** Moments of the Fresnel reflectance, as polynomials in the relative index `eta`: that on the
  * incident side over that beyond, above 1 inside a denser medium.
  */
object FresnelMoments:

  /** ∫ of the reflectance times μ over the cosine μ from 0 to 1; error at most 0.0009.
    *
    * Source: d'Eon and Irving, "A Quantized-Diffusion Model for Rendering Translucent Materials",
    * SIGGRAPH 2011, appendix.
    */
  def first(eta: Float): Float =
    val n = eta.toDouble
    val sum =
      if n < 1 then
        0.45966 + n * (-1.73965 + n * (3.37668 + n * (-3.904945 + n * (2.49277 - 0.68441 * n))))
      else
        -4.61686 + n * (11.1136 + n * (-10.4646 + n * (5.11455 + n * (-1.27198 + 0.12746 * n))))
    sum.toFloat

  /** ∫ of the reflectance times μ²; error at most 0.0015. Source: as for [[first]]. */
  def second(eta: Float): Float =
    val n = eta.toDouble
    val sum =
      if n < 1 then
        0.27614 + n * (-0.87350 + n * (1.12077 + n * (-0.65095 + n * (0.07883 + 0.04860 * n))))
      else
        val r = 1 / n
        -547.033 + r * (458.843 + r * (-218.725 + r * 45.3087)) +
          n * (404.557 + n * (-189.519 + n * (54.9327 + n * (-9.00603 + 0.63942 * n))))
    sum.toFloat

  /** Internal diffuse reflectance of a surface of index `eta` over that outside: twice [[first]],
    * by another fit.
    *
    * Source: Egan and Hilgeman, "Optical Properties of Inhomogeneous Materials", 1979; Jensen et
    * al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001, §2.
    */
  def diffuse(eta: Float): Float =
    val n = eta.toDouble
    val r = 1 / n
    val fit =
      if n >= 1 then r * (-1.4399 * r + 0.7099) + 0.6681 + 0.0636 * n
      else -0.4399 + r * (0.7099 + r * (-0.3319 + 0.0636 * r))
    fit.toFloat

/** Diffuse entry of light through a Fresnel interface: the transmittance, normalised to conserve
  * energy, since the profile already accounts for the loss.
  *
  * @param eta index of refraction inside over that outside
  *
  * Source: PBRT 3rd ed., §11.4.2.
  */
final class NormalizedFresnel(eta: Float) extends LeanBsdf:
  private val normalization = InvPi / (1f - 2f * FresnelMoments.first(1f / eta))

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isSameSide(wo, wi) then Rgb.gray(passed(wi)) else Rgb.Black

  private def passed(wi: Vec3): Float = (1f - Fresnel.dielectric(wi.z, eta)) * normalization

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isSameSide(wo, wi) then Hemisphere.cosinePdf(wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi = Hemisphere.cosineSample(wo, u1, u2)
    if Hemisphere.isSameSide(wo, wi) then
      out.set(wi, Rgb.gray(passed(wi) * Pi), Hemisphere.cosinePdf(wi), isSpecular = false)
    else out.absorb()

  def flags: BsdfFlags = BsdfFlags.Diffuse | BsdfFlags.NonReciprocal

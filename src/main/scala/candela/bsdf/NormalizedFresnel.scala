package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** Light from all directions on its way into a surface, taken as if it were scattered: what the
  * surface lets through, scaled so that in sum nothing is lost, since a profile already counts what
  * comes out as a part of what gets in.
  *
  * @param eta index of refraction inside over that outside
  *
  * Source: PBRT 3rd ed., §11.4.2.
  */
final class NormalizedFresnel(eta: Float) extends LeanBsdf:
  private val normalization = InvPi / (1f - 2f * FresnelMoments.first(1f / eta))

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.same(wo, wi) then Rgb.gray(passed(wi)) else Rgb.Black

  private def passed(wi: Vec3): Float = (1f - Fresnel.dielectric(wi.z, eta)) * normalization

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.same(wo, wi) then Hemisphere.cosinePdf(wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi = Hemisphere.cosineSample(wo, u1, u2)
    if Hemisphere.same(wo, wi) then
      out.set(wi, Rgb.gray(passed(wi) * Pi), Hemisphere.cosinePdf(wi), isSpecular = false)
    else out.absorb()

  def isSpecular: Boolean = false
  def isTransmissive: Boolean = false

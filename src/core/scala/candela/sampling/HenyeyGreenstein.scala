package candela.sampling

import candela.math.*

/** Henyey–Greenstein phase function: forward scattering for `g` > 0, backward for `g` < 0.
  *
  * @param g mean cosine of the scattering angle, in (−1, 1)
  *
  * Source: Henyey and Greenstein, "Diffuse radiation in the Galaxy", ApJ 93, 1941; sampling as in
  * PBRT 3rd ed., §15.2.3.
  */
final class HenyeyGreenstein(g: Float) extends PhaseFunction:
  private val isIsotropic = Math.abs(g) < HenyeyGreenstein.Isotropic

  def value(cosine: Float): Float = HenyeyGreenstein.value(cosine, g)

  def cosine(u: Float): Float =
    if isIsotropic then 1f - 2f * u
    else
      val s = (1f - g * g) / (1f + g - 2f * g * u)
      clamp((s * s - 1f - g * g) / (2f * g), -1f, 1f)

  def asymmetry: Float = g

object HenyeyGreenstein:
  /** Below this |g| the inversion divides rounding errors by almost zero. */
  private val Isotropic = 1e-3f

  /** @param cosTheta cosine of the angle between `wo` and `wi` */
  def value(cosTheta: Float, g: Float): Float =
    val d = 1f + g * g + 2f * g * cosTheta
    (1f - g * g) / (4f * Pi * d * safeSqrt(d))

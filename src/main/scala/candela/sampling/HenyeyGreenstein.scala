package candela.sampling

import candela.geometry.Frame
import candela.math.*

/** Henyey–Greenstein phase function: forward scattering for `g` > 0, backward for `g` < 0.
  * Directions are unit vectors that point away from the scattering point, `wo` towards the camera.
  *
  * @param g mean cosine of the scattering angle, in (−1, 1)
  *
  * Source: Henyey and Greenstein, "Diffuse radiation in the Galaxy", ApJ 93, 1941; sampling as in
  * PBRT 3rd ed., §15.2.3.
  */
final class HenyeyGreenstein(val g: Float):
  private val isIsotropic = Math.abs(g) < HenyeyGreenstein.Isotropic

  /** In sr⁻¹: the value of the phase function, which is also the pdf of [[sample]]. */
  def value(wo: Vec3, wi: Vec3): Float = HenyeyGreenstein.value(wo dot wi, g)

  /** Samples `wi` given `wo`. */
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val cosTheta =
      if isIsotropic then 1f - 2f * u1
      else
        val s = (1f - g * g) / (1f + g - 2f * g * u1)
        clamp((s * s - 1f - g * g) / (2f * g), -1f, 1f)
    val sinTheta = safeSqrt(1f - cosTheta * cosTheta)
    Frame.around(wo).toWorld(Warp.around(cosTheta, sinTheta, u2))

object HenyeyGreenstein:
  /** Below this |g| the inversion divides rounding errors by almost zero. */
  private val Isotropic = 1e-3f

  /** @param cosTheta cosine of the angle between `wo` and `wi` */
  def value(cosTheta: Float, g: Float): Float =
    val d = 1f + g * g + 2f * g * cosTheta
    (1f - g * g) / (4f * Pi * d * safeSqrt(d))

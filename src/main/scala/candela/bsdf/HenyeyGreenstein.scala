package candela.bsdf

import candela.geometry.Frame
import candela.math.*

/** How a medium scatters light forwards or back.
  *
  * @param asymmetry the mean cosine of the angle by which light turns; held to [−0.99, 0.99], where
  *                  the formula is stable
  *
  * Source: Henyey and Greenstein, "Diffuse radiation in the galaxy", Astrophysical Journal 93,
  * 1941.
  */
private[bsdf] final class HenyeyGreenstein(asymmetry: Float):
  private val g = clamp(asymmetry, -0.99f, 0.99f)

  /** The density of turning by the angle of this cosine, in sr⁻¹; `sample` draws by it. */
  def apply(cosine: Float): Float =
    val base = Math.max(1f + g * g - 2f * g * cosine, 1e-6f)
    (1f - g * g) / (4f * Pi * base * sqrt(base))

  /** A direction of travel after `w`. */
  def sample(w: Vec3, u1: Float, u2: Float): Vec3 =
    val cosine =
      if Math.abs(g) < 1e-3f then 1f - 2f * u1
      else
        val s = (1f - g * g) / (1f - g + 2f * g * u1)
        clamp((1f + g * g - s * s) / (2f * g), -1f, 1f)
    val sine = safeSqrt(1f - cosine * cosine)
    val phi = TwoPi * u2
    Frame.around(w).toWorld(Vec3(sine * cos(phi), sine * sin(phi), cosine)).normalized

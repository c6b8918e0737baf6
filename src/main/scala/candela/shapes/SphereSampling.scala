package candela.shapes

import candela.geometry.Frame
import candela.math.*

/** Sampling the part of a sphere that a point outside sees: uniform over the cone of directions.
  *
  * Source: Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", TOG
  * 15(1), 1996; small cones as in Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., §6.2.4.
  */
object SphereSampling:

  /** 1 − cos of the cone's half-angle, given sin² of it; a series where the difference would cancel
    * (sin² < 1e-4, where the next term is below 1e-9 of the result).
    */
  private def oneMinusCos(sin2: Float): Float =
    if sin2 < 1e-4f then sin2 * (0.5f + sin2 * 0.125f) else 1f - safeSqrt(1f - sin2)

  def cone(center: Vec3, radius: Float, from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    val toCenter = center - from
    val distance2 = toCenter.lengthSquared
    val sin2Max = square(radius) / distance2
    val spread = oneMinusCos(sin2Max)
    // θ is the angle at `from`, α the angle at the centre between the sample and `from`
    val oneMinusCosTheta = spread * u1
    val sin2Theta = Math.max(0f, oneMinusCosTheta * (2f - oneMinusCosTheta))
    val cosTheta = 1f - oneMinusCosTheta
    val sinMax = sqrt(sin2Max)
    val cosAlpha = sin2Theta / sinMax + cosTheta * safeSqrt(1f - sin2Theta / sin2Max)
    val sinAlpha = safeSqrt(1f - square(cosAlpha))
    val phi = u2 * TwoPi
    val frame = Frame.around(toCenter * (-1f / sqrt(distance2)))
    val n = frame.toWorld(Vec3(sinAlpha * cos(phi), sinAlpha * sin(phi), cosAlpha))
    out.n = n
    out.p = center + n * radius
    // centre + r·n: one product and one sum, each rounded; the parts may exceed the result
    out.pError = Vec3(
      (Math.abs(center.x) + Math.abs(n.x) * radius) * gamma(5),
      (Math.abs(center.y) + Math.abs(n.y) * radius) * gamma(5),
      (Math.abs(center.z) + Math.abs(n.z) * radius) * gamma(5)
    )
    out.pdf = 1f / (TwoPi * spread)

  def conePdf(center: Vec3, radius: Float, from: Vec3): Float =
    val sin2Max = square(radius) / (center - from).lengthSquared
    1f / (TwoPi * oneMinusCos(sin2Max))

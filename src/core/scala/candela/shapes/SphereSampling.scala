package candela.shapes

import candela.geometry.Frame
import candela.math.*
import candela.sampling.Warp

/** Samples the part of a sphere visible from a point outside: uniform over the cone of directions.
  *
  * Source: Shirley, Wang, Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", TOG
  * 15(1), 1996. Computed in Double: from afar the cone is too narrow for Float cosines, and close
  * to the sphere so is the angle at the centre that most of the cone spans (SphereSamplingSuite).
  */
object SphereSampling:

  /** 1 − cos of the cone's half-angle from its sin², without cancellation. */
  private def oneMinusCos(sin2: Double): Double = sin2 / (1 + Math.sqrt(Math.max(0.0, 1 - sin2)))

  private def distanceSquared(a: Vec3, b: Vec3): Double =
    val x = a.x.toDouble - b.x
    val y = a.y.toDouble - b.y
    val z = a.z.toDouble - b.z
    x * x + y * y + z * z

  def cone(
      center: Vec3,
      radius: Float,
      from: Vec3,
      u1: Float,
      u2: Float,
      out: SurfaceSample
  ): Unit =
    val radius2 = radius.toDouble * radius
    val distance2 = distanceSquared(center, from)
    val distance = Math.sqrt(distance2)
    val spread = oneMinusCos(radius2 / distance2)
    // θ is the angle at `from`, α the angle at the centre between the sample and `from`
    val oneMinusCosTheta = spread * u1
    val sin2Theta = oneMinusCosTheta * (2 - oneMinusCosTheta)
    val cosTheta = 1 - oneMinusCosTheta
    val halfChord = Math.sqrt(Math.max(0.0, radius2 - distance2 * sin2Theta))
    // d cos θ − half the chord, from the product of both roots: nothing cancels close to the sphere
    val toSample = (distance2 - radius2) / (distance * cosTheta + halfChord)
    val sinAlpha = (toSample * Math.sqrt(sin2Theta) / radius).toFloat
    val cosAlpha = ((distance - toSample * cosTheta) / radius).toFloat
    val frame = Frame.fromZ((from - center).normalized)
    val n = frame.toWorld(Warp.spherical(cosAlpha, sinAlpha, u2))
    out.n = n
    out.p = center + n * radius
    // centre + r·n: one product and one sum, each rounded; the terms may exceed the result
    out.pError = Vec3(
      (Math.abs(center.x) + Math.abs(n.x) * radius) * gamma(5),
      (Math.abs(center.y) + Math.abs(n.y) * radius) * gamma(5),
      (Math.abs(center.z) + Math.abs(n.z) * radius) * gamma(5)
    )
    out.pdf = (1 / (2 * Math.PI * spread)).toFloat

  def conePdf(center: Vec3, radius: Float, from: Vec3): Float =
    val sin2Max = radius.toDouble * radius / distanceSquared(center, from)
    (1 / (2 * Math.PI * oneMinusCos(sin2Max))).toFloat

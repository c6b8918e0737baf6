package candela.bsdf

import candela.color.Rgb
import candela.math.*

import scala.annotation.unused

/** Fresnel reflection and refraction of unpolarised light at a smooth interface.
  *
  * Computed in Double: near the critical angle and for metals of small `eta` the differences below
  * lose up to half the digits of a Float (`FresnelSuite` compares with another form of the
  * equations).
  *
  * Source: Born and Wolf, "Principles of Optics", 7th ed., §1.5.2 and §14.2.
  */
object Fresnel:

  /** Fresnel reflectance of a dielectric interface.
    *
    * @param cosThetaI cosine of the angle to the normal on the incident side; negative inside,
    *                  which inverts `eta`
    * @param eta       index of refraction inside over that outside; greater than 0
    * @return          in [0, 1]; exactly 1 past the critical angle
    */
  def dielectric(cosThetaI: Float, eta: Float): Float =
    val n = if cosThetaI < 0f then 1.0 / eta else eta.toDouble
    val cosI = Math.min(Math.abs(cosThetaI.toDouble), 1.0)
    val cos2T = 1.0 - (1.0 - cosI * cosI) / (n * n)
    if cos2T <= 0.0 then 1f
    else
      val cosT = Math.sqrt(cos2T)
      val parallel = (n * cosI - cosT) / (n * cosI + cosT)
      val perpendicular = (cosI - n * cosT) / (cosI + n * cosT)
      (0.5 * (parallel * parallel + perpendicular * perpendicular)).toFloat

  /** The cosine of the angle of refraction, at least 0; −1 for total internal reflection.
    *
    * @param cosThetaI cosine of the angle to the normal, in [0, 1]
    * @param eta       index beyond the interface over that before it
    */
  def cosRefracted(cosThetaI: Float, eta: Float): Float =
    val cosI = cosThetaI.toDouble
    val cos2T = 1.0 - Math.max(0.0, 1.0 - cosI * cosI) / (eta.toDouble * eta)
    if cos2T <= 0.0 then -1f else Math.sqrt(cos2T).toFloat

  /** The refracted direction, by Snell's law.
    *
    * @param w    unit vector that points away from the interface, on the side of `m`
    * @param m    unit normal
    * @param cosI `w dot m`, at least 0
    * @param cosT `cosRefracted(cosI, eta)`, at least 0
    * @param eta  index beyond the interface over that on the side of `w`
    */
  def refracted(w: Vec3, m: Vec3, cosI: Float, cosT: Float, eta: Float): Vec3 =
    val along = cosI / eta - cosT
    val across = -1f / eta
    // Normalised, as a small `eta` amplifies the rounding of both cosines
    Vec3(w.x * across + m.x * along, w.y * across + m.y * along, w.z * across + m.z * along)
      .normalized

  /** Fresnel reflectance of a conductor.
    *
    * @param cosThetaI cosine of the angle to the normal; its sign is ignored
    * @param eta       real part of the index of refraction, relative to the medium outside
    * @param k         imaginary part (absorption), relative to the medium outside
    */
  def conductor(cosThetaI: Float, eta: Float, k: Float): Float =
    val c = Math.min(Math.abs(cosThetaI.toDouble), 1.0)
    val n = eta.toDouble
    val kk = k.toDouble
    val s2 = 1.0 - c * c
    // (a + ib)² = (n + ik)² − sin²θ. Computes first whichever of a² and b² avoids cancellation.
    val real = n * n - kk * kk - s2
    val modulus = Math.sqrt(real * real + 4.0 * n * n * kk * kk)
    val larger = Math.sqrt(0.5 * (modulus + Math.abs(real)))
    val a =
      if real >= 0.0 then larger
      else if larger > 0.0 then n * kk / larger
      else 0.0
    val sum = modulus + c * c
    val difference = 2.0 * a * c
    if sum + difference == 0.0 then 1f // grazing, at the critical angle: the limit
    else
      val perpendicular = (sum - difference) / (sum + difference)
      val sum2 = c * c * modulus + s2 * s2
      val difference2 = difference * s2
      val parallel =
        if sum2 + difference2 == 0.0 then perpendicular
        else perpendicular * (sum2 - difference2) / (sum2 + difference2)
      // At an index of 1 rounding leaves −1e-16
      Math.max(0.0, 0.5 * (perpendicular + parallel)).toFloat

  /** [[conductor]] per channel. */
  def conductor(cosThetaI: Float, eta: Rgb, k: Rgb): Rgb = Rgb(
    conductor(cosThetaI, eta.r, k.r),
    conductor(cosThetaI, eta.g, k.g),
    conductor(cosThetaI, eta.b, k.b)
  )

  /** Approximation of [[conductor]] for strongly absorbing metals: drops sin²θ beside `eta² + k²`.
    *
    * Source: PBRT 2nd ed., §8.2.1.
    */
  def strongConductor(cosThetaI: Float, eta: Float, k: Float): Float =
    val c = Math.min(Math.abs(cosThetaI.toDouble), 1.0)
    val n2 = eta.toDouble * eta + k.toDouble * k
    val twice = 2.0 * eta * c
    val parallel = (n2 * c * c - twice + 1.0) / (n2 * c * c + twice + 1.0)
    val sum = n2 + c * c
    val perpendicular = if sum + twice == 0.0 then 1.0 else (sum - twice) / (sum + twice)
    (0.5 * (parallel + perpendicular)).toFloat

/** Reflectance of a mirror or microfacet by the angle of incidence. */
abstract class ReflectanceCurve:

  /** @param cosTheta cosine of the angle between light and mirror normal; negative if the light
    *                 arrives from inside
    */
  def apply(cosTheta: Float): Rgb

  /** What passes through a boundary.
    *
    * @param cosTheta as above
    * @param fresnel  reflectance of the boundary by itself
    */
  def transmitted(@unused cosTheta: Float, fresnel: Float): Float = 1f - fresnel

/** Reflectance 1 at every angle. */
object FullReflectance extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb.White

/** A dielectric interface: [[Fresnel.dielectric]].
  *
  * @param eta      index of refraction inside over that outside
  * @param oriented if false, both sides reflect as the outside
  */
final class DielectricReflectance(eta: Float, oriented: Boolean = true) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb =
    Rgb.gray(Fresnel.dielectric(if oriented then cosTheta else Math.abs(cosTheta), eta))

/** A conductor with a complex index of refraction per channel: [[Fresnel.conductor]]. */
final class ConductorReflectance(eta: Rgb, k: Rgb) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Fresnel.conductor(cosTheta, eta, k)

object ConductorReflectance:

  /** The conductor with `eta` 1 and the given reflectance (below 0.9999) at normal incidence, in a
    * medium of index `outside`.
    */
  def ofReflectance(reflectance: Rgb, outside: Float = 1f): ConductorReflectance =
    ConductorReflectance(
      Rgb.gray(1f / outside),
      reflectance.map: r =>
        val bounded = clamp(r, 0f, 0.9999f)
        2f * sqrt(bounded) / (sqrt(1f - bounded) * outside)
    )

/** [[Fresnel.strongConductor]] per channel. */
final class StrongConductorReflectance(eta: Rgb, k: Rgb) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb(
    Fresnel.strongConductor(cosTheta, eta.r, k.r),
    Fresnel.strongConductor(cosTheta, eta.g, k.g),
    Fresnel.strongConductor(cosTheta, eta.b, k.b)
  )

/** Piecewise linear table of a curve over equally spaced cosines; its error falls with the square
  * of `count`. Computed on first use: each colour basis has materials of its own, few of which are
  * seen.
  *
  * @param count number of cosines, from 0 (grazing) to 1; two or more
  */
final class TabulatedReflectance(count: Int, curve: Float => Rgb) extends ReflectanceCurve:
  require(count >= 2, s"`count` must be at least 2, found $count")
  private val last = count - 1

  /** r, g, b at cosine 0, then at the next. */
  private lazy val values: Array[Float] =
    val triples = new Array[Float](3 * count)
    var i = 0
    while i < count do
      val c = curve(i.toFloat / last.toFloat)
      triples(3 * i) = c.r
      triples(3 * i + 1) = c.g
      triples(3 * i + 2) = c.b
      i += 1
    triples

  def apply(cosTheta: Float): Rgb =
    val x = clamp(Math.abs(cosTheta), 0f, 1f) * last.toFloat
    val cell = Math.min(x.toInt, last - 1)
    val t = x - cell.toFloat
    Rgb(interpolate(cell, 0, t), interpolate(cell, 1, t), interpolate(cell, 2, t))

  private def interpolate(cell: Int, channel: Int, t: Float): Float =
    lerp(t, values(3 * cell + channel), values(3 * cell + 3 + channel))

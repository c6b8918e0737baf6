package candela.bsdf.layered

import candela.base.loop
import java.util.concurrent.ConcurrentHashMap

import candela.bsdf.{Fresnel, Hemisphere}
import candela.bsdf.microfacet.{MicrofacetDistribution, Roughness, RoughnessModel, TrowbridgeReitz}
import candela.geometry.ShadingPoint
import candela.math.*

/** Transmittance and internal reflectance of a clear coat over a diffuse base.
  *
  * Immutable, and independent of the base colour, so that materials share instances ([[Coats]]).
  */
abstract class Coat:

  /** Index of refraction of the coat over that outside. */
  def eta: Float

  /** Fraction of the power from the outside direction `w` that reaches the base after refraction
    * and absorption. The same for both hemispheres of `w`.
    */
  def transmittance(w: Vec3): Float

  /** Cosine-weighted average of [[transmittance]]. */
  def meanTransmittance: Float

  /** Fraction of the power emitted diffusely by the base that returns to it. */
  def internalReflectance: Float

  /** The coat of the regularised surface; see [[Bsdf.regularized]]. */
  def regularized: Coat

object Coat:

  /** Transmittance of one crossing of the coat at this cosine to the normal (Beer's law). */
  private[bsdf] def attenuation(thickness: Float, cosine: Float): Double =
    if thickness <= 0f then 1.0
    else if cosine <= 0f then 0.0
    else Math.exp(-thickness.toDouble / cosine)

/** A coat with smooth interfaces: Fresnel's equations and Beer's law.
  *
  * @param thickness in mean free paths of its absorption, at least 0
  */
final class SmoothCoat(val eta: Float, thickness: Float) extends Coat:

  def transmittance(w: Vec3): Float =
    val cosI = Math.abs(w.z)
    val cosT = Fresnel.cosRefracted(cosI, eta)
    if cosT <= 0f then 0f
    else ((1f - Fresnel.dielectric(cosI, eta)) * Coat.attenuation(thickness, cosT)).toFloat

  val meanTransmittance: Float = SmoothCoat.cosineMean(c => transmittance(Vec3(0f, 0f, c)).toDouble)

  val internalReflectance: Float = SmoothCoat.cosineMean: c =>
    val oneWay = Coat.attenuation(thickness, c)
    Fresnel.dielectric(c, 1f / eta) * oneWay * oneWay

  lazy val regularized: Coat =
    if eta == 1f then this else RoughCoat(TrowbridgeReitz.RegularizedMirror, eta, thickness)

private object SmoothCoat:

  /** ∫₀¹ 2c g(c) dc by the midpoint rule; the kink at the critical angle costs less than 1e-6. */
  private def cosineMean(g: Float => Double): Float =
    val n = 4096
    var sum = 0.0
    loop(n): i =>
      val c = (i + 0.5) / n
      sum += 2.0 * c * g(c.toFloat)
    (sum / n).toFloat

/** A coat with a rough outer interface; multiple scattering within the roughness is lost.
  *
  * `transmittance` is a table over the square root of the cosine, because it changes fastest at
  * grazing angles, and over the square of the azimuth's cosine if the roughness is anisotropic. Its
  * error is at most 0.001 (`CoatSuite`).
  */
final class RoughCoat(top: MicrofacetDistribution, val eta: Float, thickness: Float) extends Coat:
  import RoughCoat.{Azimuths, Cosines}

  private val azimuths = if top.isIsotropic then 1 else Azimuths

  // Cosines rows, each of `azimuths` values.
  private val table: Array[Float] = Array.tabulate(Cosines * azimuths): index =>
    val cosine = square((index / azimuths).toFloat / (Cosines - 1).toFloat)
    val x2 = if azimuths == 1 then 1f else (index % azimuths).toFloat / (azimuths - 1).toFloat
    val sine = safeSqrt(1f - cosine * cosine)
    RoughCoat.transmitted(top, eta, thickness, Vec3(sine * sqrt(x2), sine * sqrt(1f - x2), cosine))

  def transmittance(w: Vec3): Float =
    val row = Math.min(sqrt(Math.abs(w.z)), 1f) * (Cosines - 1).toFloat
    val i = Math.min(row.toInt, Cosines - 2)
    val t = row - i.toFloat
    if azimuths == 1 then lerp(t, table(i), table(i + 1))
    else
      val sine2 = w.x * w.x + w.y * w.y
      val column = if sine2 > 0f then w.x * w.x / sine2 * (azimuths - 1).toFloat else 0f
      val j = Math.min(column.toInt, azimuths - 2)
      val s = column - j.toFloat
      lerp(t, inRow(i, j, s), inRow(i + 1, j, s))

  private def inRow(i: Int, j: Int, s: Float): Float =
    lerp(s, table(i * azimuths + j), table(i * azimuths + j + 1))

  val meanTransmittance: Float =
    val n = 4096
    var sum = 0.0
    loop(n): i =>
      val w = Hemisphere.cosineSample(Vec3.Z, LowDiscrepancy(i, 1), LowDiscrepancy(i, 2))
      sum += transmittance(w)
    (sum / n).toFloat

  val internalReflectance: Float = RoughCoat.returned(top, eta, thickness)

  lazy val regularized: Coat =
    if top.regularized eq top then this else RoughCoat(top.regularized, eta, thickness)

private object RoughCoat:
  private inline val Cosines = 64
  private inline val Azimuths = 9

  private def transmitted(
      top: MicrofacetDistribution,
      eta: Float,
      thickness: Float,
      wo: Vec3
  ): Float =
    val n = 1024
    var sum = 0.0
    loop(n): i =>
      val m = top.sample(wo, LowDiscrepancy(i, 1), LowDiscrepancy(i, 2))
      val cosM = Math.max(0f, wo dot m)
      val cosT = Fresnel.cosRefracted(cosM, eta)
      if cosT > 0f then
        val wi = Fresnel.refracted(wo, m, cosM, cosT, eta)
        if wi.z < 0f then
          val passed = (1f - Fresnel.dielectric(cosM, eta)) * top.sampleWeight(wo, wi, m)
          sum += passed * Coat.attenuation(thickness, -wi.z)
    (sum / n).toFloat

  private def returned(top: MicrofacetDistribution, eta: Float, thickness: Float): Float =
    val n = 32768
    var sum = 0.0
    loop(n): i =>
      val incident = Hemisphere.cosineSample(Vec3.Z, LowDiscrepancy(i, 1), LowDiscrepancy(i, 2))
      val m = top.sample(incident, LowDiscrepancy(i, 3), LowDiscrepancy(i, 4))
      val cosM = incident dot m
      val reflected = Hemisphere.reflected(incident, m, cosM)
      if cosM > 0f && reflected.z > 0f then
        val weight = Fresnel.dielectric(cosM, 1f / eta) * top.sampleWeight(incident, reflected, m)
        sum += weight * Coat.attenuation(thickness, incident.z) * Coat.attenuation(
          thickness,
          reflected.z
        )
    (sum / n).toFloat

/** Quasi-random points in up to four dimensions, for integrals precomputed at scene construction.
  *
  * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: the
  * R-sequence, an additive recurrence of the powers of the real root of x⁵ = x + 1.
  */
private object LowDiscrepancy:
  private val steps = Array.tabulate(5)(d => Math.pow(1.16730397826141868426, -d.toDouble))

  /** @param dimension from 1 to 4 */
  def apply(index: Int, dimension: Int): Float =
    val x = 0.5 + (index + 1) * steps(dimension)
    belowOne((x - Math.floor(x)).toFloat)

/** Creates and caches the [[Coat]]s of a scene. Thread-safe. */
final class Coats:
  private val coats = ConcurrentHashMap[(TrowbridgeReitzKey, Float, Float), Coat]
  private val clearCoats =
    ConcurrentHashMap[((RoughnessModel, Boolean, Float, Float), Float), Coat]
  private val families = ConcurrentHashMap[(Float, Float), IArray[Coat]]

  private type TrowbridgeReitzKey = (Float, Float)
  private type Key = (TrowbridgeReitzKey, Float, Float)

  // Of thousands of materials most have the coat of the one before
  @volatile private var last: (TrowbridgeReitz, Coat, Float) | Null = null

  /** The cached coat with the outer roughness `top` and a thickness in mean free paths. */
  def of(top: TrowbridgeReitz, eta: Float, thickness: Float): Coat =
    val cached = last
    if cached != null && (cached._1 eq top) && cached._2.eta == eta && cached._3 == thickness then
      cached._2
    else
      val coat = lookUp(((top.alphaX, top.alphaY), eta, thickness), top)
      last = (top, coat, thickness)
      coat

  private def lookUp(key: Key, top: TrowbridgeReitz): Coat =
    coats.computeIfAbsent(
      key,
      _ =>
        val (_, eta, thickness) = key
        if top.isSmooth || eta == 1f then SmoothCoat(eta, thickness)
        else RoughCoat(top, eta, thickness)
    )

  /** The cached coat that absorbs nothing, with the roughness at (0, 0). */
  def clear(roughness: Roughness, eta: Float): Coat =
    val point = ShadingPoint()
    clearCoats.computeIfAbsent(
      (roughness.key(point), eta),
      _ =>
        val top = roughness(point)
        if top.isSmooth then SmoothCoat(eta, 0f) else RoughCoat(top, eta, 0f)
    )

  /** Cached coats of isotropic roughnesses from 0 to 1, denser towards 0: [[Coats.interpolate]]. */
  def family(eta: Float, thickness: Float): IArray[Coat] =
    families.computeIfAbsent(
      (eta, thickness),
      _ =>
        IArray.tabulate(Coats.Levels): i =>
          val alpha = square(i.toFloat / (Coats.Levels - 1).toFloat)
          of(TrowbridgeReitz(alpha, alpha), eta, thickness)
    )

object Coats:

  /** Number of nodes of `family` over the square root of the roughness. */
  inline val Levels = 33

  /** Interpolates the coat of any roughness from 0 to 1, with an error of at most 0.003
    * (`CoatSuite`). Anisotropic roughnesses use their geometric mean.
    */
  def interpolate(family: IArray[Coat], top: TrowbridgeReitz): Coat =
    val isotropic = top.alphaX == top.alphaY
    val root = if isotropic then sqrt(top.alphaX) else sqrt(sqrt(top.alphaX * top.alphaY))
    val level = clamp(root, 0f, 1f) * (Levels - 1).toFloat
    val i = Math.min(level.toInt, Levels - 2)
    BlendedCoat(family, top, i, level - i.toFloat)

/** Linear interpolation at `t` between the `i`th coat of a family and the next. */
private final class BlendedCoat(family: IArray[Coat], top: TrowbridgeReitz, i: Int, t: Float)
    extends Coat:
  private val a = family(i)
  private val b = family(i + 1)

  def eta: Float = a.eta
  def transmittance(w: Vec3): Float = lerp(t, a.transmittance(w), b.transmittance(w))
  def meanTransmittance: Float = lerp(t, a.meanTransmittance, b.meanTransmittance)
  def internalReflectance: Float = lerp(t, a.internalReflectance, b.internalReflectance)
  def regularized: Coat = Coats.interpolate(family, top.regularized)

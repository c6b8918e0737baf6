package candela.sampling

import candela.geometry.Frame
import candela.math.*

/** How a medium scatters: the density of directions in sr⁻¹, which depends on the angle between
  * them only. Directions are unit vectors that point away from the scattering point, `wo` towards
  * the camera; light that goes straight on has a cosine of −1 between them.
  */
abstract class PhaseFunction:
  /** The density where `wo` and `wi` have this cosine. */
  def value(cosine: Float): Float

  /** Samples the cosine. */
  def cosine(u: Float): Float

  /** Mean cosine of the angle by which light is turned; 1: straight on. */
  def asymmetry: Float

  /** The value of the phase function, which is also the pdf of [[sample]]. */
  final def value(wo: Vec3, wi: Vec3): Float = value(wo dot wi)

  /** Samples `wi` given `wo`. */
  final def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val cosTheta = cosine(u1)
    val sinTheta = safeSqrt(1f - cosTheta * cosTheta)
    Frame.fromZ(wo).toWorld(Warp.spherical(cosTheta, sinTheta, u2))

object PhaseFunction:
  /** Words for the kinds that [[of]] sums. */
  val Kinds: Vector[String] = Vector("hg", "rayleigh", "tabulated")

  /** A sum of phase functions; None if the arguments don't fit together.
    *
    * @param weights of the kinds, at least 0; they sum to 1
    * @param values  of each kind in turn: of "hg" its g, of "tabulated" the number of its values,
    *                and the values
    */
  def of(
      kinds: Vector[String],
      weights: Vector[Float],
      values: Vector[Float]
  ): Option[PhaseFunction] =
    val fits = weights.size == kinds.size && weights.forall(_ >= 0f) &&
      Math.abs(weights.sum - 1f) < 1e-4f
    val start = Option((Vector.empty[PhaseFunction], values))
    val parsed = kinds.foldLeft(start): (made, kind) =>
      for
        (done, from) <- made
        (part, rest) <- next(kind, from)
      yield (done :+ part, rest)
    parsed.collect:
      case (Vector(single), Vector()) if fits => single
      case (several, Vector()) if fits => BlendedPhase(several.toArray, weights.toArray)

  /** One phase function, made of the first of the numbers, and the other numbers. */
  private def next(kind: String, from: Vector[Float]): Option[(PhaseFunction, Vector[Float])] =
    (kind, from) match
      case ("rayleigh", _) => Some((Rayleigh, from))
      case ("hg", g +: rest) if Math.abs(g) < 1f => Some((HenyeyGreenstein(g), rest))
      case ("tabulated", count +: rest) if count >= 2f && count <= rest.size =>
        val (values, others) = rest.splitAt(count.toInt)
        Option.when(values.forall(_ >= 0f))((TabulatedPhase(values.toArray), others))
      case _ => None

/** Rayleigh scattering: by molecules, much smaller than the wavelength.
  *
  * Source: Frisvad, "Importance sampling the Rayleigh phase function", JOSA A 28(12), 2011.
  */
object Rayleigh extends PhaseFunction:
  def value(cosine: Float): Float = 3f / (16f * Pi) * (1f + cosine * cosine)

  def cosine(u: Float): Float =
    // The root of a cubic
    val z = 4.0 * u - 2.0
    val a = Math.cbrt(Math.abs(z) + Math.sqrt(z * z + 1.0))
    clamp(Math.copySign(a - 1.0 / a, z).toFloat, -1f, 1f)

  def asymmetry: Float = 0f

/** Linear between values at equal steps of the cosine of the angle by which light is turned, the
  * first at −1 (back) and the last at 1 (straight on), scaled to a density.
  */
final class TabulatedPhase(values: Array[Float]) extends PhaseFunction:
  require(values.length > 1, "a tabulated phase function needs at least two values")
  private val last = values.length - 1
  private val steps = Discrete(Array.tabulate(last)(i => 0.5f * (values(i) + values(i + 1))))
  private val scale =
    val area = (0 until last).map(i => 0.5 * (values(i).toDouble + values(i + 1))).sum * 2.0 / last
    (if area > 0.0 then 1.0 / (2.0 * Math.PI * area) else 0.0).toFloat

  def value(cosine: Float): Float =
    val x = (1f - clamp(cosine, -1f, 1f)) * 0.5f * last
    val i = Math.min(x.toInt, last - 1)
    scale * lerp(x - i, values(i), values(i + 1))

  def cosine(u: Float): Float =
    val i = steps.sample(u)
    val areaFraction = steps.remapped(u, i)
    val (a, b) = (values(i).toDouble, values(i + 1).toDouble)
    // The fraction of the step below which `areaFraction` of its area lies, without cancellation
    val height = a + Math.sqrt(a * a + areaFraction * (b * b - a * a))
    val fraction = if height > 0.0 then areaFraction * (a + b) / height else areaFraction.toDouble
    (1.0 - 2.0 * (i + fraction) / last).toFloat

  def asymmetry: Float =
    // Of each step: the integral of the product of two lines
    val sum = (0 until last).map: i =>
      val (x, y) = (2.0 * i / last - 1.0, 2.0 * (i + 1) / last - 1.0)
      val (a, b) = (values(i).toDouble, values(i + 1).toDouble)
      (2.0 * (a * x + b * y) + a * y + b * x) / 6.0 * 2.0 / last
    (sum.sum * 2.0 * Math.PI * scale).toFloat

/** A sum of others by weight; the weights sum to 1. */
final class BlendedPhase(parts: Array[PhaseFunction], weights: Array[Float]) extends PhaseFunction:
  private val choice = Discrete(weights)

  def value(cosine: Float): Float =
    var sum = 0f
    var i = 0
    while i < parts.length do
      sum += weights(i) * parts(i).value(cosine)
      i += 1
    sum

  def cosine(u: Float): Float =
    val i = choice.sample(u)
    parts(i).cosine(choice.remapped(u, i))

  def asymmetry: Float = parts.lazyZip(weights).map(_.asymmetry * _).sum

package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** How much a mirror, large or a microfacet, reflects at each angle. */
abstract class ReflectanceCurve:

  /** @param cosTheta cosine of the angle between light and mirror normal; negative if the light
    *                 arrives from the inside of the surface
    */
  def apply(cosTheta: Float): Rgb

/** Reflects all at every angle. */
object FullReflectance extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb.White

/** The interface of two transparent media: [[Fresnel.dielectric]].
  *
  * @param eta      index of refraction inside over that outside
  * @param oriented false if the inside looks like the outside
  */
final class DielectricReflectance(eta: Float, oriented: Boolean = true) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb =
    Rgb.gray(Fresnel.dielectric(if oriented then cosTheta else Math.abs(cosTheta), eta))

/** A metal of the given complex index in each channel: [[Fresnel.conductor]]. */
final class ConductorReflectance(eta: Rgb, k: Rgb) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Fresnel.conductor(cosTheta, eta, k)

object ConductorReflectance:

  /** The metal with `eta` 1 that reflects `reflectance` (below 0.9999) at normal incidence, seen
    * from a medium of index `outside`.
    */
  def ofReflectance(reflectance: Rgb, outside: Float = 1f): ConductorReflectance =
    ConductorReflectance(
      Rgb.gray(1f / outside),
      reflectance.map: r =>
        val bounded = clamp(r, 0f, 0.9999f)
        2f * sqrt(bounded) / (sqrt(1f - bounded) * outside)
    )

/** [[Fresnel.strongConductor]] in each channel. */
final class StrongConductorReflectance(eta: Rgb, k: Rgb) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb(
    Fresnel.strongConductor(cosTheta, eta.r, k.r),
    Fresnel.strongConductor(cosTheta, eta.g, k.g),
    Fresnel.strongConductor(cosTheta, eta.b, k.b)
  )

/** A curve given by its values at equally spaced cosines, linear between them.
  *
  * @param values r, g, b at cosine 0 (grazing), then at the next, up to cosine 1; two or more
  *               triples
  */
final class TabulatedReflectance(values: IArray[Float]) extends ReflectanceCurve:
  require(values.length >= 6 && values.length % 3 == 0, s"${values.length} values are no curve")
  private val last = values.length / 3 - 1

  def apply(cosTheta: Float): Rgb =
    val x = clamp(Math.abs(cosTheta), 0f, 1f) * last.toFloat
    val cell = Math.min(x.toInt, last - 1)
    val t = x - cell.toFloat
    Rgb(between(cell, 0, t), between(cell, 1, t), between(cell, 2, t))

  private def between(cell: Int, channel: Int, t: Float): Float =
    lerp(t, values(3 * cell + channel), values(3 * cell + 3 + channel))

object TabulatedReflectance:

  /** The table of `curve` at `count` cosines; its error falls with the square of `count`. */
  def of(count: Int)(curve: Float => Rgb): TabulatedReflectance =
    val triples = Vector.tabulate(count)(i => curve(i.toFloat / (count - 1).toFloat))
    TabulatedReflectance(IArray.from(triples.flatMap(c => Vector(c.r, c.g, c.b))))

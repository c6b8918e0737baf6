package candela.convert

import candela.base.loop
import candela.bsdf.composite.{GltfDiffuse, GltfReflectance}
import candela.bsdf.layered.{Coat, Coats}
import candela.bsdf.microfacet.TrowbridgeReitz
import candela.color.Rgb
import candela.math.*

/** Reflectances of pbrt-v4's materials that reflect as much diffusely, in light from all sides, as
  * the base of glTF's dielectric.
  *
  * @param eta   index of refraction
  * @param alpha width of the facets' slopes
  */
private[convert] final class DielectricBase(eta: Float, alpha: Float):
  /** Reflectance of the facets at normal incidence. */
  val normal: Float = square((eta - 1f) / (eta + 1f))

  /** Mean of what they let through. */
  private val passed: Float =
    import DielectricBase.*
    val white = GltfDiffuse(Rgb.White, GltfReflectance(Rgb.gray(normal), 1f, Rgb.Black, 0f))
    var sum = 0.0
    loop(Directions): i =>
      loop(Directions): j =>
        loop(Directions): k =>
          sum += white.f(direction(i, 0), direction(j, k)).g * Pi
    (sum / (Directions * Directions * Directions)).toFloat

  private val coat: Coat = Coats().of(TrowbridgeReitz(alpha, alpha), eta, 0f)

  // Down through the coat, and up again by the reciprocity of the two ways
  private val crossing = square(coat.meanTransmittance / eta)

  /** Of the base of `coateddiffuse`, whose coat reflects light back to it.
    *
    * @param color of glTF's base, in [0, 1]
    */
  def underCoat(color: Float): Float =
    val diffuse = color * passed
    Math.min(diffuse / (crossing + diffuse * coat.internalReflectance), 1f)

  /** Whether a base under a coat can be as bright. */
  def fitsUnderCoat(color: Float): Boolean =
    val base = underCoat(color)
    val diffuse = crossing * base / (1f - base * coat.internalReflectance)
    diffuse >= (1f - DielectricBase.Tolerance) * color * passed

  /** The greatest share that highlights can have in a blend with a base of this colour. */
  def highlights(color: Float): Float = clamp(1f - color * passed, normal, 1f)

  /** Of a base blended with highlights that have the share. */
  def beside(share: Float, color: Float): Float =
    if share >= 1f then 0f else clamp(color * passed / (1f - share), 0f, 1f)

private object DielectricBase:
  private val Directions = 24

  /** Within which two renderings of a model are taken for alike. */
  private val Tolerance = 0.02f

  /** The middle of a part of the hemisphere; all parts have equal projections on its base. */
  private def direction(row: Int, column: Int): Vec3 =
    val sine2 = (row + 0.5f) / Directions
    val azimuth = 2 * Pi * (column + 0.5f) / Directions
    Vec3(sqrt(sine2) * cos(azimuth), sqrt(sine2) * sin(azimuth), sqrt(1f - sine2))

package candela.accel

import candela.base.loop
import scala.collection.mutable.ArrayBuffer

import candela.geometry.{Ray, ShadingPoint}
import candela.sampling.SampleHash
import candela.textures.FloatTexture

/** Alpha test of a surface. */
abstract class Mask:

  /** Whether the ray passes through `primitive` at this point (alpha cutout). Deterministic for a
    * given ray.
    *
    * @param at     hit point, in the space of the ray
    * @param shadow whether the ray is an occlusion query
    */
  def isHole(at: ShadingPoint, ray: Ray, primitive: Int, shadow: Boolean): Boolean

  /** The mask in two parts: that of rays of all kinds, and a veil's, whose openings stop light
    * samples.
    */
  def veiled: (Mask, Mask) = (SolidMask, this)

/** Fully opaque. */
object SolidMask extends Mask:
  def isHole(at: ShadingPoint, ray: Ray, primitive: Int, shadow: Boolean): Boolean = false

/** Alpha cutout: `alpha` 0 is transparent; `shadowAlpha` 0 also, for shadow rays only. As in
  * pbrt-v2 and v3.
  */
final class HoleMask(alpha: FloatTexture, shadowAlpha: FloatTexture) extends Mask:
  def isHole(at: ShadingPoint, ray: Ray, primitive: Int, shadow: Boolean): Boolean =
    alpha(at) == 0f || (shadow && shadowAlpha(at) == 0f)

/** Stochastic alpha: a ray passes with probability 1 − `alpha`, decided by a hash of the ray.
  *
  * @param separate whether also of the primitive: surfaces one behind another are then passed
  *   independently. In pbrt-v4, what passes one passes all of no higher alpha.
  *
  * Source: Wyman and McGuire, "Improved Alpha Testing Using Hashed Sampling", TVCG 23(8), 2017, for
  * hashed thresholds.
  */
final class StochasticMask(alpha: FloatTexture, separate: Boolean) extends Mask:
  def isHole(at: ShadingPoint, ray: Ray, primitive: Int, shadow: Boolean): Boolean =
    val a = alpha(at)
    a < 1f && (!(a > 0f) || StochasticMask.threshold(ray, if separate then primitive else 0) >= a)

/** Also open to rays that meet the surface from behind. */
final class FrontMask(inner: Mask) extends Mask:
  override def veiled: (Mask, Mask) = (FrontMask(SolidMask), inner)
  def isHole(at: ShadingPoint, ray: Ray, primitive: Int, shadow: Boolean): Boolean =
    (ray.direction dot at.geometricNormal) > 0f || inner.isHole(at, ray, primitive, shadow)

object StochasticMask:
  /** Uniform in [0, 1) over rays and primitives. */
  private def threshold(ray: Ray, primitive: Int): Float =
    val h = SampleHash.mix64(SampleHash.ofRay(ray) + primitive * SampleHash.Step)
    SampleHash.toUnit((h >>> 32).toInt)

/** The masks of a set of primitives; [[SolidMask]] if opaque.
  *
  * @param ofMesh  indexed by mesh of the triangle soup
  * @param ofShape indexed by other shape
  */
final class Masks(val ofMesh: Array[Mask], val ofShape: Array[Mask]):
  private def count(masks: Array[Mask]): Int = masks.count(_ ne SolidMask)
  val meshes: Int = count(ofMesh)
  val shapes: Int = count(ofShape)
  def isEmpty: Boolean = meshes == 0 && shapes == 0

object Masks:
  val Empty: Masks = Masks(Array.empty, Array.empty)

  /** Empty if all is opaque. */
  def of(meshes: MaskColumn, shapes: MaskColumn): Masks =
    if meshes.isOpaque && shapes.isOpaque then Empty else Masks(meshes.toArray, shapes.toArray)

/** Collects the masks of meshes or of shapes; those before the first that is not opaque are only
  * counted, as there may be millions.
  */
final class MaskColumn:
  private var opaque = 0
  private val masks = ArrayBuffer.empty[Mask]

  def isOpaque: Boolean = masks.isEmpty

  /** Adds the mask of so many shapes. */
  def add(mask: Mask, count: Int = 1): Unit =
    if isOpaque && (mask eq SolidMask) then opaque += count
    else loop(count)(_ => masks += mask)

  def toArray: Array[Mask] = Array.fill[Mask](opaque)(SolidMask) ++ masks

package candela.accel

import candela.geometry.{Hit, Ray}
import candela.shapes.{Shape, TriangleTest}

/** Primitives in the order in which an accelerator's leaves hold them.
  *
  * A scene is traced through one of the two kinds only, so the call from the leaf has one target.
  */
abstract class PackedPrimitives:
  /** Tests the slots from `first` until `end`; on a hit shortens the ray and fills `hit`. */
  def intersect(first: Int, end: Int, ray: Ray, hit: Hit): Boolean

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean

object PackedPrimitives:
  /** Of two primitives at the same distance the one of the lower number is met, so that the answer
    * does not depend on the order of asking: triangles see to that themselves, for others the ray
    * is as long as the next Float.
    */
  private[accel] inline def withTies(primitive: Int, ray: Ray, hit: Hit)(
      inline intersect: Boolean
  ): Boolean =
    val end = ray.tMax
    if primitive < hit.primitive then ray.tMax = Math.nextUp(end)
    val found = intersect
    if !found || ray.tMax > end then ray.tMax = end
    found

/** Primitives without holes.
  *
  * @param order   which primitive is in each slot
  * @param corners nine Floats a slot: x, y, z of a triangle's corners; unused for the others
  */
final class SolidPrimitives(
    order: Array[Int],
    corners: Array[Float],
    triangles: Int,
    shapes: Array[Shape],
    instances: Instances
) extends PackedPrimitives:
  private val firstInstance = triangles + shapes.length

  def intersect(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    var found = false
    var slot = first
    while slot < end do
      val primitive = order(slot)
      val here =
        if primitive < triangles then
          TriangleTest.intersect(corners, 9 * slot, 1, primitive, ray, hit)
        else other(primitive, ray, hit)
      if here then
        hit.primitive = primitive
        found = true
      slot += 1
    found

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    var found = false
    var slot = first
    while !found && slot < end do
      val primitive = order(slot)
      found =
        if primitive < triangles then TriangleTest.isHit(corners, 9 * slot, ray, hit)
        else isOtherHit(primitive, ray, hit)
      slot += 1
    found

  private def other(primitive: Int, ray: Ray, hit: Hit): Boolean =
    PackedPrimitives.withTies(primitive, ray, hit):
      if primitive < firstInstance then shapes(primitive - triangles).intersect(ray, hit)
      else instances.intersect(primitive - firstInstance, ray, hit)

  private def isOtherHit(primitive: Int, ray: Ray, hit: Hit): Boolean =
    if primitive < firstInstance then shapes(primitive - triangles).isHit(ray)
    else instances.isHit(primitive - firstInstance, ray, hit)

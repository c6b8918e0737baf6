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
        if primitive < triangles then TriangleTest.intersect(corners, 9 * slot, ray, hit)
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
    if primitive < firstInstance then shapes(primitive - triangles).intersect(ray, hit)
    else instances.intersect(primitive - firstInstance, ray, hit)

  private def isOtherHit(primitive: Int, ray: Ray, hit: Hit): Boolean =
    if primitive < firstInstance then shapes(primitive - triangles).isHit(ray)
    else instances.isHit(primitive - firstInstance, ray, hit)

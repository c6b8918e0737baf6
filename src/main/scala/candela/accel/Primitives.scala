package candela.accel

import candela.base.loop
import candela.geometry.{Bounds3, Hit, Ray}
import candela.shapes.{Shape, TriangleSoup, TriangleTest}

/** All that a ray can meet, numbered: the triangles of the soup first, then the other shapes, then
  * the instances of objects.
  */
final class Primitives(
    val soup: TriangleSoup,
    val shapes: Array[Shape],
    val instances: Instances = Instances.None
):
  private val firstInstance = soup.count + shapes.length
  def count: Int = firstInstance + instances.count

  /** Lower and upper corner of each primitive's box: six Floats. */
  def bounds: Array[Float] =
    val all = new Array[Float](6 * count)
    loop(count)(i => write(all, 6 * i, boundsOf(i)))
    all

  private def boundsOf(i: Int): Bounds3 =
    if i < soup.count then soup.bounds(i)
    else if i < firstInstance then shapes(i - soup.count).bounds
    else instances.bounds(i - firstInstance)

  private def write(to: Array[Float], at: Int, b: Bounds3): Unit =
    to(at) = b.min.x
    to(at + 1) = b.min.y
    to(at + 2) = b.min.z
    to(at + 3) = b.max.x
    to(at + 4) = b.max.y
    to(at + 5) = b.max.z

  /** The primitives in the given order, packed for testing one after the other. */
  def packed(order: Array[Int]): PackedPrimitives =
    val corners = new Array[Float](9 * order.length)
    loop(order.length): slot =>
      val triangle = order(slot)
      if triangle < soup.count then
        loop(9): k =>
          corners(9 * slot + k) = soup.positions(3 * soup.indices(3 * triangle + k / 3) + k % 3)
    PackedPrimitives(order, corners, soup.count, shapes, instances)

/** Primitives in the order in which an accelerator's leaves hold them.
  *
  * @param order   which primitive is in each slot
  * @param corners nine Floats a slot: x, y, z of a triangle's corners; unused for the others
  */
final class PackedPrimitives(
    order: Array[Int],
    corners: Array[Float],
    triangles: Int,
    shapes: Array[Shape],
    instances: Instances
):
  private val firstInstance = triangles + shapes.length

  /** Tests the slots from `first` until `end`; on a hit shortens the ray and fills `hit`. */
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

package candela.accel

import candela.geometry.{Hit, Ray}
import candela.shapes.{ShapeGroup, TriangleSoup, TriangleTest}

/** Primitives in the leaf order of an accelerator.
  *
  * A scene uses only one of the two subclasses, so the call from a leaf is monomorphic.
  */
abstract class PackedPrimitives:
  /** Tests the slots from `first` until `end`; on a hit shortens the ray and fills `hit`. */
  def intersect(first: Int, end: Int, ray: Ray, hit: Hit): Boolean

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean

object PackedPrimitives:
  /** Breaks ties: of two primitives at the same distance the lower number wins, so that the result
    * does not depend on traversal order. Triangle tests do this themselves; for other shapes the
    * ray is extended to the next Float. These compare distances as they are stored, in Float.
    */
  private[accel] inline def withTies(primitive: Int, ray: Ray, hit: Hit)(
      inline intersect: Boolean
  ): Boolean =
    val end = ray.tMax
    if primitive < hit.primitive then ray.tMax = Math.nextUp(end)
    val found = intersect
    if !found || ray.tMax > end then ray.tMax = end
    found

/** Opaque primitives.
  *
  * @param order   primitive in each slot
  * @param corners nine Floats per slot: x, y, z of a triangle's corners; unused for other shapes;
  *   empty if there are no triangles
  */
final class SolidPrimitives(
    order: Array[Int],
    corners: Array[Float],
    triangles: Int,
    shapes: Array[? <: ShapeGroup],
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
      if primitive < firstInstance then
        ShapeGroup.intersect(shapes, primitive - triangles, ray, hit)
      else instances.intersect(primitive - firstInstance, ray, hit)

  private def isOtherHit(primitive: Int, ray: Ray, hit: Hit): Boolean =
    if primitive < firstInstance then ShapeGroup.isHit(shapes, primitive - triangles, ray)
    else instances.isHit(primitive - firstInstance, ray, hit)

/** Primitives of which some are alpha-masked: their hits pass the alpha test or are rejected.
  *
  * @param order, corners as in [[SolidPrimitives]]
  */
final class MaskedPrimitives(
    order: Array[Int],
    corners: Array[Float],
    soup: TriangleSoup,
    shapes: Array[? <: ShapeGroup],
    instances: Instances,
    masks: Masks
) extends PackedPrimitives:
  private val triangles = soup.count
  private val firstInstance = triangles + shapes.length

  def intersect(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    var found = false
    var slot = first
    while slot < end do
      if test(slot, ray, hit, shadow = false) then
        hit.primitive = order(slot)
        found = true
      slot += 1
    found

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    val tMax = ray.tMax
    var found = false
    var slot = first
    while !found && slot < end do
      found = test(slot, ray, hit, shadow = true)
      slot += 1
    ray.tMax = tMax
    found

  private def test(slot: Int, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    val primitive = order(slot)
    if primitive < triangles then
      val mask = masks.ofMesh(soup.meshOf(primitive))
      if mask eq SolidMask then triangle(slot, ray, hit, shadow)
      else triangle(slot, mask, ray, hit, shadow)
    else if shadow then other(primitive, ray, hit, shadow)
    else PackedPrimitives.withTies(primitive, ray, hit)(other(primitive, ray, hit, shadow))

  private def other(primitive: Int, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    if primitive < firstInstance then
      val i = primitive - triangles
      val mask = masks.ofShape(i)
      if mask eq SolidMask then ShapeGroup.intersect(shapes, i, ray, hit)
      else solid(shapes(i), i, primitive, mask, ray, hit, shadow)
    else if shadow then instances.isHit(primitive - firstInstance, ray, hit)
    else instances.intersect(primitive - firstInstance, ray, hit)

  /** `hit` holds the previous hit only in closest-hit queries. */
  private def triangle(slot: Int, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    val number = if shadow then Int.MaxValue else order(slot)
    TriangleTest.intersect(corners, 9 * slot, 1, number, ray, hit)

  private def triangle(slot: Int, mask: Mask, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    val tMax = ray.tMax
    val u = hit.u
    val v = hit.v
    if !triangle(slot, ray, hit, shadow) then false
    else
      val at = hit.work
      soup.surface(order(slot), hit, at)
      if mask.isHole(at, ray, order(slot), shadow) then
        ray.tMax = tMax
        hit.u = u
        hit.v = v
        false
      else true

  /** A shape may be hit again behind a cutout: the search continues with a ray spawned there. */
  private def solid(
      shapes: ShapeGroup,
      number: Int,
      primitive: Int,
      mask: Mask,
      ray: Ray,
      hit: Hit,
      shadow: Boolean
  ): Boolean =
    val u = hit.u
    val v = hit.v
    val at = hit.work
    val rest = ray.nested
    val direction = ray.direction
    rest.set(ray.origin, direction, ray.tMax)
    var passed = 0f
    var found = false
    var going = shapes.intersect(number, rest, hit)
    while going do
      shapes.surface(number, rest, hit, at)
      if mask.isHole(at, rest, primitive, shadow) then
        passed += rest.tMax
        rest.set(at.offsetOrigin(direction), direction, ray.tMax - passed)
        going = shapes.intersect(number, rest, hit)
      else
        found = true
        going = false
    if found then ray.tMax = passed + rest.tMax
    else
      hit.u = u
      hit.v = v
    found

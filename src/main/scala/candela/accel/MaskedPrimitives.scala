package candela.accel

import candela.geometry.{Hit, Ray}
import candela.shapes.{Shape, TriangleSoup, TriangleTest}

/** Primitives some of which have holes: a hit on one of these is looked at more closely, and where
  * there is a hole it is none.
  *
  * @param order, corners as in [[SolidPrimitives]]
  */
final class MaskedPrimitives(
    order: Array[Int],
    corners: Array[Float],
    soup: TriangleSoup,
    shapes: Array[Shape],
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
      if mask eq SolidMask then shapes(i).intersect(ray, hit)
      else solid(shapes(i), primitive, mask, ray, hit, shadow)
    else if shadow then instances.isHit(primitive - firstInstance, ray, hit)
    else instances.intersect(primitive - firstInstance, ray, hit)

  /** `hit` says what was met before only if the closest is asked for. */
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

  /** A shape may be met again behind a hole: on from there with a ray that leaves it. */
  private def solid(
      shape: Shape,
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
    var going = shape.intersect(rest, hit)
    while going do
      shape.surface(rest, hit, at)
      if mask.isHole(at, rest, primitive, shadow) then
        passed += rest.tMax
        rest.set(at.offsetOrigin(direction), direction, ray.tMax - passed)
        going = shape.intersect(rest, hit)
      else
        found = true
        going = false
    if found then ray.tMax = passed + rest.tMax
    else
      hit.u = u
      hit.v = v
    found

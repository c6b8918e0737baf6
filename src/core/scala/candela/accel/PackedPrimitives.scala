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
    val hasHit = intersect
    if !hasHit || ray.tMax > end then ray.tMax = end
    hasHit

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
    var hasHit = false
    var slot = first
    while slot < end do
      val primitive = order(slot)
      val isCloser =
        if primitive < triangles then
          TriangleTest.intersect(corners, 9 * slot, 1, primitive, ray, hit)
        else intersectOther(primitive, ray, hit)
      if isCloser then
        hit.primitive = primitive
        hasHit = true
      slot += 1
    hasHit

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    var hasHit = false
    var slot = first
    while !hasHit && slot < end do
      val primitive = order(slot)
      hasHit =
        if primitive < triangles then TriangleTest.isHit(corners, 9 * slot, ray, hit)
        else isOtherHit(primitive, ray, hit)
      slot += 1
    hasHit

  private def intersectOther(primitive: Int, ray: Ray, hit: Hit): Boolean =
    PackedPrimitives.withTies(primitive, ray, hit):
      if primitive < firstInstance then
        ShapeGroup.intersect(shapes, primitive - triangles, ray, hit)
      else instances.intersect(primitive - firstInstance, ray, hit)

  private def isOtherHit(primitive: Int, ray: Ray, hit: Hit): Boolean =
    if primitive < firstInstance then ShapeGroup.isHit(shapes, primitive - triangles, ray)
    else instances.isHit(primitive - firstInstance, ray, hit)

/** Triangles of which some are alpha-masked: their hits pass the alpha test or are rejected. */
final class MaskedTriangles(soup: TriangleSoup, masks: Masks):
  def isEmpty: Boolean = masks.meshes == 0

  /** As [[TriangleTest.intersect]], whose parameters these are, with the alpha test.
    *
    * @param shadow whether the query is for occlusion: the ray stays as it is, but `hit` changes
    */
  def intersect(
      v: Array[Float],
      at: Int,
      stride: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit,
      shadow: Boolean
  ): Boolean =
    val tMax = ray.tMax
    val u0 = hit.u
    val v0 = hit.v
    val number = if shadow then Int.MaxValue else primitive
    val isMet = TriangleTest.intersect(v, at, stride, number, ray, hit) &&
      !isHole(primitive, ray, hit, shadow)
    if !isMet then
      hit.u = u0
      hit.v = v0
    if shadow || !isMet then ray.tMax = tMax
    isMet

  private def isHole(primitive: Int, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    val mask = masks.ofMesh(soup.meshOf(primitive))
    if mask eq SolidMask then false
    else
      soup.surface(primitive, hit, hit.work)
      mask.isHole(hit.work, ray, primitive, shadow)

/** Primitives of which some are alpha-masked.
  *
  * @param order, corners, triangles as in [[SolidPrimitives]]
  * @param masks those of the shapes
  */
final class MaskedPrimitives(
    order: Array[Int],
    corners: Array[Float],
    maskedTriangles: MaskedTriangles,
    triangles: Int,
    shapes: Array[? <: ShapeGroup],
    instances: Instances,
    masks: Array[Mask]
) extends PackedPrimitives:
  private val firstInstance = triangles + shapes.length

  def intersect(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    var hasHit = false
    var slot = first
    while slot < end do
      val primitive = order(slot)
      val isCloser =
        if primitive < triangles then
          maskedTriangles.intersect(corners, 9 * slot, 1, primitive, ray, hit, shadow = false)
        else PackedPrimitives.withTies(primitive, ray, hit)(testShape(primitive, ray, hit, false))
      if isCloser then
        hit.primitive = primitive
        hasHit = true
      slot += 1
    hasHit

  def isHit(first: Int, end: Int, ray: Ray, hit: Hit): Boolean =
    val tMax = ray.tMax
    var hasHit = false
    var slot = first
    while !hasHit && slot < end do
      val primitive = order(slot)
      hasHit =
        if primitive < triangles then
          maskedTriangles.intersect(corners, 9 * slot, 1, primitive, ray, hit, shadow = true)
        else testShape(primitive, ray, hit, shadow = true)
      slot += 1
    ray.tMax = tMax
    hasHit

  private def testShape(primitive: Int, ray: Ray, hit: Hit, shadow: Boolean): Boolean =
    if primitive < firstInstance then
      val i = primitive - triangles
      val mask = masks(i)
      if mask eq SolidMask then ShapeGroup.intersect(shapes, i, ray, hit)
      else solid(shapes(i), i, primitive, mask, ray, hit, shadow)
    else if shadow then instances.isHit(primitive - firstInstance, ray, hit)
    else instances.intersect(primitive - firstInstance, ray, hit)

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
    val surfacePoint = hit.work
    val remainingRay = ray.nested
    val direction = ray.direction
    remainingRay.set(ray.origin, direction, ray.tMax)
    remainingRay.isPrimary = ray.isPrimary
    var passed = 0f
    var hasHit = false
    var going = shapes.intersect(number, remainingRay, hit)
    while going do
      shapes.surface(number, remainingRay, hit, surfacePoint)
      if mask.isHole(surfacePoint, remainingRay, primitive, shadow) then
        passed += remainingRay.tMax
        remainingRay.set(surfacePoint.offsetOrigin(direction), direction, ray.tMax - passed)
        going = shapes.intersect(number, remainingRay, hit)
      else
        hasHit = true
        going = false
    if hasHit then ray.tMax = passed + remainingRay.tMax
    else
      hit.u = u
      hit.v = v
    hasHit

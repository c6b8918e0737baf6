package candela.accel

import candela.base.loop
import candela.concurrency.Parallel
import candela.shapes.{ShapeGroup, TriangleSoup}

/** All primitives that rays can hit, in order: the triangles of the soup, the other shapes, the
  * object instances.
  *
  * @param shapes each row has the group of its number
  */
final class Primitives(
    val soup: TriangleSoup,
    val shapes: Array[? <: ShapeGroup],
    val instances: Instances = Instances.Empty,
    val masks: Masks = Masks.Empty
):
  private val firstInstance = soup.count + shapes.length
  def count: Int = firstInstance + instances.count

  def isTriangle(i: Int): Boolean = i < soup.count

  /** The masks of triangles. */
  private[accel] def maskedTriangles: MaskedTriangles = MaskedTriangles(soup, masks)

  /** Bounds of each primitive as six Floats: lower and upper corner. */
  def bounds: Array[Float] =
    val boxes = new Array[Float](6 * count)
    loop(count)(i => writeBounds(boxes, 6 * i, i))
    boxes

  /** Writes the bounds of primitive `i` as six Floats. */
  private[accel] def writeBounds(to: Array[Float], at: Int, i: Int): Unit =
    if i < soup.count then soup.bounds(i).write(to, at)
    else if i < firstInstance then shapes(i - soup.count).writeBounds(i - soup.count, to, at)
    else instances.bounds(i - firstInstance).write(to, at)

  /** Primitives packed in the given order for sequential tests. */
  def packed(order: Array[Int], parallel: Parallel = Parallel.Alone): PackedPrimitives =
    // Other shapes have no corners, and there may be millions
    val corners = if soup.count == 0 then Array.emptyFloatArray else cornersOf(order, parallel)
    if masks.isEmpty then SolidPrimitives(order, corners, soup.count, shapes, instances)
    else
      MaskedPrimitives(
        order, corners, maskedTriangles, soup.count, shapes, instances, masks.ofShape
      )

  private def cornersOf(order: Array[Int], parallel: Parallel): Array[Float] =
    val corners = new Array[Float](Math.multiplyExact(9, order.length))
    parallel.ranges(order.length): (from, until) =>
      var slot = from
      while slot < until do
        val triangle = order(slot)
        if triangle < soup.count then
          loop(3): k =>
            System.arraycopy(
              soup.positions,
              3 * soup.indices(3 * triangle + k),
              corners,
              9 * slot + 3 * k,
              3
            )
        slot += 1
    corners

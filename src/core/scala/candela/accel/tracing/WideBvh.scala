package candela.accel.tracing

import candela.accel.{Accelerator, WideTree}
import candela.geometry.{Bounds3, Hit, Ray}
import candela.math.magnitudeBits

/** A wide BVH whose branching factor is the number of boxes that SIMD code tests at once.
  *
  * Rays are traced by scalar code until the JVM has compiled the SIMD kernel (see [[WarmUp]]). The
  * choice of kernel never affects an image: all find bit-identical hits.
  *
  * @param fast   kernel for all rays once it is faster
  * @param atOnce whether `fast` is used without a warm-up
  * @param warmUps those of the job, otherwise
  */
final class WideBvh private[tracing] (
    tree: WideTree,
    fast: WideKernel,
    atOnce: Boolean,
    warmUps: WarmUps = WarmUps()
) extends Accelerator:
  val bounds: Bounds3 = tree.bounds
  private val isRangeSafe = WideKernel.isRangeSafe(bounds)

  def describe: String =
    s"bvh: ${tree.count} primitives, ${tree.nodeCount} nodes of ${tree.width} children, " +
      s"${tree.blockCount} blocks of ${tree.lanes} triangles; ${fast.name}" +
      (if atOnce then "" else ", scalar until they are compiled")

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    traverse(ray, warmUps.closest, _.closest(tree, ray, hit))

  def isOccluded(ray: Ray, hit: Hit): Boolean =
    traverse(ray, warmUps.occluded, _.isOccluded(tree, ray, hit))

  private inline def traverse(
      ray: Ray,
      warmUp: WarmUp,
      inline by: WideKernel => Boolean
  ): Boolean =
    if !(isRangeSafe && WideKernel.isRangeSafe(ray)) then by(CarefulKernel)
    else if atOnce || warmUp.isOver then by(fast)
    else by(ScalarKernel)

/** Traversal kernel for a [[WideTree]]. All kernels find bit-identical hits; rays and tree must
  * be range-safe.
  */
private[tracing] abstract class WideKernel:
  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean
  def name: String

private[tracing] object WideKernel:
  /** Whether products of coordinates, also with inverse directions, stay within the range of
    * Floats: the error of a box's distances is then at most [[WideWalk.Slack]], and the edge
    * functions of [[candela.shapes.TriangleTest]] are never NaN.
    *
    * One condition, of the signs of differences of bits: each branch that is taken for the first
    * time late in a render costs the JVM a compilation.
    */
  def isRangeSafe(ray: Ray): Boolean =
    (positionCheck(ray.ox) & positionCheck(ray.oy) & positionCheck(ray.oz) &
      directionCheck(ray.dx) & directionCheck(ray.dy) & directionCheck(ray.dz)) < 0

  def isRangeSafe(box: Bounds3): Boolean =
    box.isEmpty || (positionCheck(box.min.x) & positionCheck(box.min.y) & positionCheck(box.min.z) &
      positionCheck(box.max.x) & positionCheck(box.max.y) & positionCheck(box.max.z)) < 0

  /** Negative if |x| < [[Far]]; not for NaN. */
  private inline def positionCheck(x: Float): Int = magnitudeBits(x) - Far

  /** Negative if |x| is zero or between [[Small]] and [[Large]]; not for NaN. Zero is safe: a box
    * that the ray misses then begins at infinity.
    */
  private inline def directionCheck(x: Float): Int =
    val bits = magnitudeBits(x)
    (bits - Large) & ((Small - bits) | (bits - 1))

  private val Far = java.lang.Float.floatToRawIntBits(1e18f)
  private val Large = java.lang.Float.floatToRawIntBits(1e30f)
  private val Small = java.lang.Float.floatToRawIntBits(1e-30f)

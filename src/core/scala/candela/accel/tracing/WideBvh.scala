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
  private val isTame = WideKernel.isTame(bounds)

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
    if !(isTame && WideKernel.isTame(ray)) then by(CarefulKernel)
    else if atOnce || warmUp.isOver then by(fast)
    else by(ScalarKernel)

/** Traversal kernel for a [[WideTree]]. All kernels find bit-identical hits; rays and tree must be
  * tame.
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
  def isTame(ray: Ray): Boolean =
    (near(ray.ox) & near(ray.oy) & near(ray.oz) &
      usual(ray.dx) & usual(ray.dy) & usual(ray.dz)) < 0

  def isTame(box: Bounds3): Boolean =
    box.isEmpty || (near(box.min.x) & near(box.min.y) & near(box.min.z) &
      near(box.max.x) & near(box.max.y) & near(box.max.z)) < 0

  /** Negative if |x| < [[Far]]; not for NaN. */
  private inline def near(x: Float): Int = magnitudeBits(x) - Far

  /** Negative if |x| is zero or between [[Small]] and [[Large]]; not for NaN. Zero is tame: a box
    * that the ray misses then begins at infinity.
    */
  private inline def usual(x: Float): Int =
    val bits = magnitudeBits(x)
    (bits - Large) & ((Small - bits) | (bits - 1))

  private val Far = java.lang.Float.floatToRawIntBits(1e18f)
  private val Large = java.lang.Float.floatToRawIntBits(1e30f)
  private val Small = java.lang.Float.floatToRawIntBits(1e-30f)

package candela.accel.tracing

import candela.accel.{Accelerator, WideTree}
import candela.geometry.{Bounds3, Hit, Ray}

/** A wide BVH whose branching factor is the number of boxes that SIMD code tests at once.
  *
  * A ray object's first traversals use scalar code: a small image is finished before the JVM has
  * compiled the SIMD kernel. After that, the SIMD kernel is tried until it is faster (see
  * [[WarmUp]]). The choice of kernel never affects an image: all find bit-identical hits.
  *
  * @param fast     kernel for all rays once it is faster
  * @param patience number of traversals per ray object after which `fast` is tried; 0 to use it at
  *   once
  */
final class WideBvh private[tracing] (tree: WideTree, fast: WideKernel, patience: Int)
    extends Accelerator:
  val bounds: Bounds3 = tree.bounds
  private val isTame = WideKernel.isTame(bounds)
  private val isAlwaysFast = patience == 0

  def describe: String =
    s"bvh: ${tree.count} primitives, ${tree.nodeCount} nodes of ${tree.width} children, " +
      s"${tree.blockCount} blocks of ${tree.lanes} triangles; ${fast.name}" +
      (if fast eq ScalarKernel then "" else s", for the first $patience rays scalar")

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    traverse(ray, WarmUp.closest, _.closest(tree, ray, hit), tryClosest(ray, hit))

  def isOccluded(ray: Ray, hit: Hit): Boolean =
    traverse(ray, WarmUp.occluded, _.isOccluded(tree, ray, hit), tryOccluded(ray, hit))

  private inline def traverse(
      ray: Ray,
      warmUp: WarmUp,
      inline by: WideKernel => Boolean,
      inline attempt: => Boolean
  ): Boolean =
    if !(isTame && WideKernel.isTame(ray)) then by(CarefulKernel)
    else if isAlwaysFast || warmUp.isOver then by(fast)
    else if ray.walks < patience then
      ray.walks += 1
      by(ScalarKernel)
    else if warmUp.claimsTrial() then attempt
    else by(ScalarKernel)

  private def tryClosest(ray: Ray, hit: Hit): Boolean =
    compare(ray, hit, WarmUp.closest, _.closest(tree, ray, hit))

  private def tryOccluded(ray: Ray, hit: Hit): Boolean =
    compare(ray, hit, WarmUp.occluded, _.isOccluded(tree, ray, hit))

  /** Runs the same traversal by both kernels and measures their times. */
  private inline def compare(
      ray: Ray,
      hit: Hit,
      warmUp: WarmUp,
      inline by: WideKernel => Boolean
  ): Boolean =
    val end = ray.tMax
    val begin = System.nanoTime
    by(ScalarKernel): Unit
    val middle = System.nanoTime
    ray.tMax = end
    hit.primitive = -1
    val found = by(fast)
    warmUp.record(middle - begin, System.nanoTime - middle)
    found

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
    */
  def isTame(ray: Ray): Boolean =
    isTame(ray.ox) && isTame(ray.oy) && isTame(ray.oz) &&
      isTameDirection(ray.dx) && isTameDirection(ray.dy) && isTameDirection(ray.dz)

  def isTame(box: Bounds3): Boolean =
    box.isEmpty || (isTame(box.min.x) && isTame(box.min.y) && isTame(box.min.z) &&
      isTame(box.max.x) && isTame(box.max.y) && isTame(box.max.z))

  /** False for NaN, too. */
  private inline def isTame(x: Float): Boolean = Math.abs(x) < Far

  /** Zero is tame: a box that the ray misses then begins at infinity. */
  private inline def isTameDirection(x: Float): Boolean =
    x == 0f || (Math.abs(x) > Small && Math.abs(x) < Large)

  private final val Far = 1e18f
  private final val Large = 1e30f
  private final val Small = 1e-30f

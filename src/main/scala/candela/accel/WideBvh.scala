package candela.accel

import candela.geometry.{Bounds3, Hit, Ray}

/** A bounding volume hierarchy whose nodes have as many children as vectors test in one go.
  *
  * A ray's first walks are done in plain Scala: until the JVM has compiled it, code with vectors is
  * a hundred times slower, and a small picture is finished by then. Which kernel walks is never
  * seen in a picture: all find the same hits, bit by bit.
  *
  * @param fast     for rays that have been walking for a while
  * @param patience after how many walks of a ray object that is
  */
final class WideBvh private[accel] (tree: WideTree, fast: WideKernel, patience: Int)
    extends Accelerator:
  val bounds: Bounds3 = tree.bounds
  private val isTame = WideKernel.isTame(bounds)

  def describe: String =
    s"bvh: ${tree.count} primitives, ${tree.nodeCount} nodes of ${tree.width} children, " +
      s"${tree.blockCount} blocks of ${tree.lanes} triangles; ${fast.name}" +
      (if fast eq ScalarKernel then "" else s", for the first $patience rays scalar")

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    if !(isTame && WideKernel.isTame(ray)) then CarefulKernel.closest(tree, ray, hit)
    else if ray.walks >= patience then fast.closest(tree, ray, hit)
    else
      ray.walks += 1
      ScalarKernel.closest(tree, ray, hit)

  def isOccluded(ray: Ray, hit: Hit): Boolean =
    if !(isTame && WideKernel.isTame(ray)) then CarefulKernel.isOccluded(tree, ray, hit)
    else if ray.walks >= patience then fast.isOccluded(tree, ray, hit)
    else
      ray.walks += 1
      ScalarKernel.isOccluded(tree, ray, hit)

package candela.accel

import candela.geometry.{Bounds3, Hit, Ray}

/** A bounding volume hierarchy whose nodes have as many children as vectors test in one go.
  *
  * A ray's first walks are done in plain Scala: a small picture is finished before the JVM has
  * compiled code with vectors. After that many, vectors are tried until they are faster (see
  * [[WarmUp]]). Which kernel walks is never seen in a picture: all find the same hits, bit by bit.
  *
  * @param fast     for all rays once it is faster
  * @param patience after how many walks of a ray object it is tried; 0: it is taken at once
  */
final class WideBvh private[accel] (tree: WideTree, fast: WideKernel, patience: Int)
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
    if !(isTame && WideKernel.isTame(ray)) then CarefulKernel.closest(tree, ray, hit)
    else if isAlwaysFast || WarmUp.closest.isOver then fast.closest(tree, ray, hit)
    else if ray.walks < patience then
      ray.walks += 1
      ScalarKernel.closest(tree, ray, hit)
    else if WarmUp.closest.turn() then tryClosest(ray, hit)
    else ScalarKernel.closest(tree, ray, hit)

  def isOccluded(ray: Ray, hit: Hit): Boolean =
    if !(isTame && WideKernel.isTame(ray)) then CarefulKernel.isOccluded(tree, ray, hit)
    else if isAlwaysFast || WarmUp.occluded.isOver then fast.isOccluded(tree, ray, hit)
    else if ray.walks < patience then
      ray.walks += 1
      ScalarKernel.isOccluded(tree, ray, hit)
    else if WarmUp.occluded.turn() then tryOccluded(ray, hit)
    else ScalarKernel.isOccluded(tree, ray, hit)

  private def tryClosest(ray: Ray, hit: Hit): Boolean =
    val end = ray.tMax
    val begin = System.nanoTime
    ScalarKernel.closest(tree, ray, hit): Unit
    val middle = System.nanoTime
    ray.tMax = end
    hit.primitive = -1
    val found = fast.closest(tree, ray, hit)
    WarmUp.closest.tell(middle - begin, System.nanoTime - middle)
    found

  private def tryOccluded(ray: Ray, hit: Hit): Boolean =
    val begin = System.nanoTime
    ScalarKernel.isOccluded(tree, ray, hit): Unit
    val middle = System.nanoTime
    val found = fast.isOccluded(tree, ray, hit)
    WarmUp.occluded.tell(middle - begin, System.nanoTime - middle)
    found

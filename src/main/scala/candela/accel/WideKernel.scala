package candela.accel

import candela.geometry.{Bounds3, Hit, Ray}

/** A way to walk a [[WideTree]]. All find the same hits, bit by bit; rays and tree must be tame. */
private[accel] abstract class WideKernel:
  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean
  def name: String

private[accel] object WideKernel:
  /** Neither products of coordinates nor those with inverse directions leave the range of Floats:
    * then a box's distances are off by no more than [[WideWalk.Slack]], and the edge functions of
    * [[candela.shapes.TriangleTest]] are numbers.
    */
  def isTame(ray: Ray): Boolean =
    isTame(ray.ox) && isTame(ray.oy) && isTame(ray.oz) &&
      isTameDirection(ray.dx) && isTameDirection(ray.dy) && isTameDirection(ray.dz)

  def isTame(box: Bounds3): Boolean =
    box.isEmpty || (isTame(box.min.x) && isTame(box.min.y) && isTame(box.min.z) &&
      isTame(box.max.x) && isTame(box.max.y) && isTame(box.max.z))

  /** False for NaN, too. */
  private inline def isTame(x: Float): Boolean = Math.abs(x) < Far

  /** Zeros are: a box beside the ray then begins at infinity. */
  private inline def isTameDirection(x: Float): Boolean =
    x == 0f || (Math.abs(x) > Small && Math.abs(x) < Large)

  private final val Far = 1e18f
  private final val Large = 1e30f
  private final val Small = 1e-30f

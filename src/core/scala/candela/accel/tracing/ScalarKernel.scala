package candela.accel.tracing

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}

/** Traverses a [[WideTree]] by scalar code: for JVMs without the Vector API, and until the JVM has
  * compiled [[VectorKernel]].
  *
  * Minima and maxima are on Ints, and decisions are computed from sign bits: branches that depend
  * on boxes and triangles are unpredictable (docs/decisions/0010-ray-kernels.md).
  */
private[tracing] object ScalarKernel extends WideKernel:
  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean =
    if isNarrow(tree) then traverse(tree, 4, 4, ray, hit, false)
    else traverse(tree, tree.width, tree.lanes, ray, hit, false)

  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean =
    if isNarrow(tree) then traverse(tree, 4, 4, ray, hit, true)
    else traverse(tree, tree.width, tree.lanes, ray, hit, true)

  def name: String = "scalar"

  /** Constant sizes let the JVM unroll the loops. */
  private def isNarrow(tree: WideTree): Boolean = tree.width == 4 && tree.lanes == 4

  private inline def traverse(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline anyHit: Boolean
  ): Boolean =
    WideWalk.traverse(
      tree,
      width,
      lanes,
      ray,
      hit,
      anyHit,
      (node, limit) => childrenHit(tree.nodes, node, width, ray, limit - WideWalk.Slack, anyHit),
      corners => trianglesHit(tree.blocks, corners, lanes, ray),
      // Every candidate is tested as if it were at an edge
      marksEdges = false,
      inRange = (_, _) => 0,
      inside = (_, _) => false
    )

  /** Bit mask of the children that the ray hits. Of a slab's two distances the lesser one, as an
    * Int, is the near one, unless both are negative, and the slab is behind the origin.
    */
  private inline def childrenHit(
      b: Array[Float],
      node: Int,
      inline width: Int,
      ray: Ray,
      end: Int,
      inline anyHit: Boolean
  ): Int =
    var missed = 0
    var k = 0
    while k < width do
      val lowX = plane(b(node + k), ray.ox, ray.invX)
      val highX = plane(b(node + 3 * width + k), ray.ox, ray.invX)
      val lowY = plane(b(node + width + k), ray.oy, ray.invY)
      val highY = plane(b(node + 4 * width + k), ray.oy, ray.invY)
      val lowZ = plane(b(node + 2 * width + k), ray.oz, ray.invZ)
      val highZ = plane(b(node + 5 * width + k), ray.oz, ray.invZ)
      val tNear = Math.max(
        Math.max(Math.min(lowX, highX), Math.min(lowY, highY)),
        Math.max(Math.min(lowZ, highZ), 0)
      )
      val tFar = Math.min(
        Math.min(Math.max(lowX, highX), Math.max(lowY, highY)),
        Math.min(Math.max(lowZ, highZ), end)
      )
      inline if !anyHit then ray.lanes(k) = tNear
      // Tests far + Slack < near; the difference must not overflow if far is negative
      missed |= ((Math.max(tFar, BelowAnyDistance) + WideWalk.Slack - tNear) >>> 31) << k
      k += 1
    missed ^ ((1 << width) - 1)

  /** Less than any distance, by more than the slack. */
  private inline val BelowAnyDistance = -100

  private inline def plane(x: Float, o: Float, i: Float): Int = bits((x - o) * i)

  /** Bit mask of the block's lanes whose triangles may be hit: the Float part of
    * [[candela.shapes.TriangleTest]], operation by operation.
    */
  private inline def trianglesHit(v: Array[Float], corners: Int, inline lanes: Int, ray: Ray): Int =
    val x = corners + ray.kx * lanes
    val y = corners + ray.ky * lanes
    val z = corners + ray.kz * lanes
    val ox = ray.oAlongX
    val oy = ray.oAlongY
    val oz = ray.oAlongZ
    val shearX = ray.shearX
    val shearY = ray.shearY
    var candidates = 0
    var k = 0
    while k < lanes do
      val z0 = v(z + k) - oz
      val z1 = v(z + 3 * lanes + k) - oz
      val z2 = v(z + 6 * lanes + k) - oz
      val x0 = v(x + k) - ox + shearX * z0
      val y0 = v(y + k) - oy + shearY * z0
      val x1 = v(x + 3 * lanes + k) - ox + shearX * z1
      val y1 = v(y + 3 * lanes + k) - oy + shearY * z1
      val x2 = v(x + 6 * lanes + k) - ox + shearX * z2
      val y2 = v(y + 6 * lanes + k) - oy + shearY * z2
      val e0 = x1 * y2 - y1 * x2
      val e1 = x2 * y0 - y2 * x0
      val e2 = x0 * y1 - y0 * x1
      val s0 = bits(e0)
      val s1 = bits(e1)
      val s2 = bits(e2)
      val productBits = bits(e0 * e1 * e2) & Int.MaxValue
      // No sign bit, all sign bits, or a zero, for which the product is also zero or NaN
      val zero = (productBits - 1) | (WideWalk.Infinity - productBits)
      candidates |= ((~(s0 | s1 | s2) | (s0 & s1 & s2) | zero) >>> 31) << k
      k += 1
    candidates

  private inline def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

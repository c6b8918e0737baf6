package candela.accel.tracing

import jdk.incubator.vector.{FloatVector, IntVector, VectorMask, VectorOperators, VectorSpecies}

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}
import candela.shapes.TriangleTest

/** Traverses a [[WideTree]] with the JDK's Vector API: SIMD tests of a node or a triangle block at
  * once. The tree's blocks have as many triangles as a vector has lanes.
  *
  * Requires the module jdk.incubator.vector when first accessed.
  */
private[tracing] object VectorKernel extends WideKernel:
  // Static and final: constants to the JVM's compiler. Not more than 8 lanes: blocks of 16
  // triangles have large boxes, and some processors halve vectors of 512 bits (decision 0010)
  private val isWide = FloatVector.SPECIES_PREFERRED.length > 8
  private val F: VectorSpecies[java.lang.Float] =
    if isWide then FloatVector.SPECIES_256 else FloatVector.SPECIES_PREFERRED
  private val I: VectorSpecies[Integer] =
    if isWide then IntVector.SPECIES_256 else IntVector.SPECIES_PREFERRED
  private val W: Int = F.length

  /** In earlier versions, converting a mask to bits allocates. */
  private val HasMaskBits = Runtime.version.feature >= 19
  private val LaneBits: IntVector = IntVector.fromArray(I, Array.tabulate(W)(1 << _), 0)
  private val Zeros: IntVector = IntVector.zero(I)
  private val Infinities: IntVector = IntVector.broadcast(I, WideWalk.Infinity)

  /** Two vectors of children, or one of sixteen lanes; a mask has as many bits. */
  private val N: Int = Math.min(16, 2 * W)

  def width: Int = N
  def lanes: Int = W
  def isWorthIt: Boolean = W >= 4
  def name: String = s"vectors of $W"

  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean = traverse(tree, ray, hit, false)
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean = traverse(tree, ray, hit, true)

  private inline def traverse(tree: WideTree, ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    val b = tree.nodes
    val t = tree.blocks
    WideWalk.traverse(
      tree,
      N,
      W,
      ray,
      hit,
      anyHit,
      (node, limit) =>
        val low = childrenHit(b, node, limit, ray, 0, anyHit)
        if N == W then low else low | (childrenHit(b, node + W, limit, ray, W, anyHit) << W)
      ,
      corners => trianglesHit(t, corners, ray),
      marksEdges = true,
      (corners, tMax) => trianglesWithin(t, corners, ray, tMax),
      (at, owner) =>
        inline if anyHit then isHit(t, at, ray, hit) else intersect(t, at, owner, ray, hit)
    )

  // Not part of the kernel, whose compilation would take longer than the calls
  private def intersect(t: Array[Float], at: Int, owner: Int, ray: Ray, hit: Hit): Boolean =
    TriangleTest.intersectInside(t, at, W, owner, ray, hit)

  private def isHit(t: Array[Float], at: Int, ray: Ray, hit: Hit): Boolean =
    TriangleTest.isHitInside(t, at, W, ray, hit)

  /** One bit for each set lane. */
  private inline def bits(m: VectorMask[Integer]): Int =
    if HasMaskBits then m.toLong.toInt
    else Zeros.blend(LaneBits, m).reduceLanes(VectorOperators.OR)

  private inline def plane(b: Array[Float], at: Int, o: Float, i: Float): IntVector =
    FloatVector.fromArray(F, b, at).sub(o).mul(i).reinterpretAsInts()

  /** Bit mask of the children that the ray hits, for one vector of children from `node` on. Of a
    * slab's two distances the lesser one, as an Int, is the near one, unless both are negative, and
    * the slab is behind the origin.
    */
  private inline def childrenHit(
      b: Array[Float],
      node: Int,
      limit: Int,
      ray: Ray,
      inline lane: Int,
      inline anyHit: Boolean
  ): Int =
    val lowX = plane(b, node, ray.ox, ray.invX)
    val highX = plane(b, node + 3 * N, ray.ox, ray.invX)
    val lowY = plane(b, node + N, ray.oy, ray.invY)
    val highY = plane(b, node + 4 * N, ray.oy, ray.invY)
    val lowZ = plane(b, node + 2 * N, ray.oz, ray.invZ)
    val highZ = plane(b, node + 5 * N, ray.oz, ray.invZ)
    val tNear = lowX.min(highX).max(lowY.min(highY)).max(lowZ.min(highZ)).max(0)
    val tFar = lowX
      .max(highX)
      .min(lowY.max(highY))
      .min(lowZ.max(highZ))
      .add(WideWalk.Slack)
      .min(limit)
    inline if !anyHit then tNear.intoArray(ray.lanes, lane)
    bits(tNear.compare(VectorOperators.LE, tFar))

  // No vector lives longer than a node or a block: the JVM would store it to memory repeatedly, in
  // case it has to leave compiled code
  private inline def trianglesHit(t: Array[Float], corners: Int, ray: Ray): Int =
    // The Float part of TriangleTest, operation by operation
    val x = corners + ray.kx * W
    val y = corners + ray.ky * W
    val z = corners + ray.kz * W
    val z0 = FloatVector.fromArray(F, t, z).sub(ray.oAlongZ)
    val z1 = FloatVector.fromArray(F, t, z + 3 * W).sub(ray.oAlongZ)
    val z2 = FloatVector.fromArray(F, t, z + 6 * W).sub(ray.oAlongZ)
    val x0 = FloatVector.fromArray(F, t, x).sub(ray.oAlongX).add(z0.mul(ray.shearX))
    val x1 = FloatVector.fromArray(F, t, x + 3 * W).sub(ray.oAlongX).add(z1.mul(ray.shearX))
    val x2 = FloatVector.fromArray(F, t, x + 6 * W).sub(ray.oAlongX).add(z2.mul(ray.shearX))
    val y0 = FloatVector.fromArray(F, t, y).sub(ray.oAlongY).add(z0.mul(ray.shearY))
    val y1 = FloatVector.fromArray(F, t, y + 3 * W).sub(ray.oAlongY).add(z1.mul(ray.shearY))
    val y2 = FloatVector.fromArray(F, t, y + 6 * W).sub(ray.oAlongY).add(z2.mul(ray.shearY))
    val e0 = x1.mul(y2).sub(y1.mul(x2))
    val e1 = x2.mul(y0).sub(y2.mul(x0))
    val e2 = x0.mul(y1).sub(y0.mul(x1))
    val s0 = e0.reinterpretAsInts()
    val s1 = e1.reinterpretAsInts()
    val s2 = e2.reinterpretAsInts()
    val productBits = e0.mul(e1).mul(e2).reinterpretAsInts().and(Int.MaxValue)
    val zero = productBits.sub(1).or(Infinities.sub(productBits))
    // One or two sign bits, or a zero, for which the product is also zero or NaN
    val candidates = s0.or(s1).or(s2).lanewise(VectorOperators.XOR, s0.and(s1).and(s2)).or(zero)
    bits(candidates.compare(VectorOperators.GE, 0)) |
      (bits(zero.compare(VectorOperators.LT, 0)) << WideWalk.FirstEdgeBit)

  /** Bits of the lanes whose triangles are neither behind the ray nor past its end, along the axis
    * of its largest component: no hit is farther outside the triangle's box than the padding.
    */
  private inline def trianglesWithin(t: Array[Float], corners: Int, ray: Ray, tMax: Float): Int =
    val z = corners + ray.kz * W
    val z0 = FloatVector.fromArray(F, t, z).sub(ray.oAlongZ)
    val z1 = FloatVector.fromArray(F, t, z + 3 * W).sub(ray.oAlongZ)
    val z2 = FloatVector.fromArray(F, t, z + 6 * W).sub(ray.oAlongZ)
    val pad = z1.sub(z0).abs().add(z2.sub(z0).abs()).mul(WideWalk.Pad)
    val end = tMax * ray.dAlongZ * WideWalk.Beyond
    val low = FloatVector.broadcast(F, Math.min(0f, end)).sub(pad)
    val high = FloatVector.broadcast(F, Math.max(0f, end)).add(pad)
    val below = z0.sub(low).reinterpretAsInts()
      .and(z1.sub(low).reinterpretAsInts())
      .and(z2.sub(low).reinterpretAsInts())
    val above = high.sub(z0).reinterpretAsInts()
      .and(high.sub(z1).reinterpretAsInts())
      .and(high.sub(z2).reinterpretAsInts())
    val inRange = bits(below.or(above).compare(VectorOperators.GE, 0))
    inRange | (inRange << WideWalk.FirstEdgeBit)

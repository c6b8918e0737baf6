package candela.accel

import jdk.incubator.vector.{FloatVector, IntVector, VectorOperators, VectorSpecies}

import candela.geometry.{Hit, Ray}

/** Walks a [[WideTree]] by the JDK's Vector API, a node or a block of triangles in one go. The tree
  * has as many lanes as this machine's vectors.
  *
  * To be touched only where the module jdk.incubator.vector is there.
  */
private[accel] object VectorKernel extends WideKernel:
  // Static and final once compiled, so that the JVM's compiler knows them
  private val isHuge = FloatVector.SPECIES_PREFERRED.length > 16
  private val F: VectorSpecies[java.lang.Float] =
    if isHuge then FloatVector.SPECIES_512 else FloatVector.SPECIES_PREFERRED
  private val I: VectorSpecies[Integer] =
    if isHuge then IntVector.SPECIES_512 else IntVector.SPECIES_PREFERRED
  private val W: Int = F.length

  /** Before, asking a mask for its bits made an object. */
  private val HasMaskBits = Runtime.version.feature >= 19
  private val LaneBits: IntVector = IntVector.fromArray(I, Array.tabulate(W)(1 << _), 0)

  def lanes: Int = W
  def isWorthIt: Boolean = W >= 4
  def name: String = s"vectors of $W"

  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean = walk(tree, ray, hit, false)
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean = walk(tree, ray, hit, true)

  private inline def slab(b: Array[Float], at: Int, o: FloatVector, i: FloatVector): IntVector =
    FloatVector.fromArray(F, b, at).sub(o).mul(i).reinterpretAsInts()

  /** One bit for each lane that is negative. */
  private inline def signs(v: IntVector): Int =
    if HasMaskBits then v.compare(VectorOperators.LT, 0).toLong.toInt
    else
      v.lanewise(VectorOperators.ASHR, 31).and(LaneBits).reduceLanes(VectorOperators.OR)

  private inline def walk(tree: WideTree, ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    val b = tree.nodes
    val ox = FloatVector.broadcast(F, ray.ox)
    val oy = FloatVector.broadcast(F, ray.oy)
    val oz = FloatVector.broadcast(F, ray.oz)
    val ix = FloatVector.broadcast(F, ray.invX)
    val iy = FloatVector.broadcast(F, ray.invY)
    val iz = FloatVector.broadcast(F, ray.invZ)
    // Where in a node the near plane of each axis stands, and the far one
    val nx = W * (if ray.invX < 0f then 3 else 0)
    val ny = W * (if ray.invY < 0f then 4 else 1)
    val nz = W * (if ray.invZ < 0f then 5 else 2)
    val fx = 3 * W - nx
    val fy = 5 * W - ny
    val fz = 7 * W - nz
    val begins = ray.lanes
    val t = tree.blocks
    val kx = ray.kx
    val ky = ray.ky
    val kz = ray.kz
    WideWalk.walk(
      tree,
      ray,
      hit,
      anyHit,
      (node, limit) =>
        val near = slab(b, node + nx, ox, ix)
          .max(slab(b, node + ny, oy, iy))
          .max(slab(b, node + nz, oz, iz))
          .max(0)
        val far = slab(b, node + fx, ox, ix)
          .min(slab(b, node + fy, oy, iy))
          .min(slab(b, node + fz, oz, iz))
          .add(WideWalk.Slack)
          .min(limit)
        near.intoArray(begins, 0)
        if HasMaskBits then near.compare(VectorOperators.LE, far).toLong.toInt
        else signs(far.max(-1).sub(near).not())
      ,
      corners =>
        // The Float part of TriangleTest, operation by operation
        val x = FloatVector.broadcast(F, ray.along(kx))
        val y = FloatVector.broadcast(F, ray.along(ky))
        val z = FloatVector.broadcast(F, ray.along(kz))
        val shearX = FloatVector.broadcast(F, ray.shearX)
        val shearY = FloatVector.broadcast(F, ray.shearY)
        val z0 = FloatVector.fromArray(F, t, corners + kz * W).sub(z)
        val z1 = FloatVector.fromArray(F, t, corners + (3 + kz) * W).sub(z)
        val z2 = FloatVector.fromArray(F, t, corners + (6 + kz) * W).sub(z)
        val x0 = FloatVector.fromArray(F, t, corners + kx * W).sub(x).add(z0.mul(shearX))
        val y0 = FloatVector.fromArray(F, t, corners + ky * W).sub(y).add(z0.mul(shearY))
        val x1 = FloatVector.fromArray(F, t, corners + (3 + kx) * W).sub(x).add(z1.mul(shearX))
        val y1 = FloatVector.fromArray(F, t, corners + (3 + ky) * W).sub(y).add(z1.mul(shearY))
        val x2 = FloatVector.fromArray(F, t, corners + (6 + kx) * W).sub(x).add(z2.mul(shearX))
        val y2 = FloatVector.fromArray(F, t, corners + (6 + ky) * W).sub(y).add(z2.mul(shearY))
        val e0 = x1.mul(y2).sub(y1.mul(x2))
        val e1 = x2.mul(y0).sub(y2.mul(x0))
        val e2 = x0.mul(y1).sub(y0.mul(x1))
        val zero = e0.mul(e1).mul(e2).reinterpretAsInts().and(Int.MaxValue).sub(1)
        val s0 = e0.reinterpretAsInts()
        val s1 = e1.reinterpretAsInts()
        val s2 = e2.reinterpretAsInts()
        // No sign, or all signs, or a zero
        signs(s0.or(s1).or(s2).not().or(s0.and(s1).and(s2)).or(zero))
    )

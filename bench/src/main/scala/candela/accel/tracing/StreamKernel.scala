package candela.accel.tracing

import jdk.incubator.vector.{FloatVector, IntVector, VectorMask, VectorOperators, VectorSpecies}

import candela.accel.WideTree

import java.lang.invoke.{MethodHandle, MethodHandles, MethodType}

/** The vector code of [[RayStreams]]: as many rays as a vector has lanes against one box, or one
  * triangle, at a time. Rays are records of sixteen Floats, a cache line each; lists hold where
  * records begin.
  */
private[tracing] object StreamKernel:
  private val F: VectorSpecies[java.lang.Float] = FloatVector.SPECIES_PREFERRED
  private val I: VectorSpecies[Integer] = IntVector.SPECIES_PREFERRED
  private val Iota: IntVector = IntVector.zero(I).addIndex(1)
  private val Zeros: IntVector = IntVector.zero(I)
  private val Infinities: IntVector = IntVector.broadcast(I, WideWalk.Infinity)

  val Lanes: Int = F.length

  /** `IntVector.compress`, which JDK 17, by whose classes this is compiled, doesn't have. A constant
    * to the JVM's compiler.
    */
  private val Compress: MethodHandle = MethodHandles
    .publicLookup()
    .findVirtual(
      classOf[IntVector],
      "compress",
      MethodType.methodType(classOf[IntVector], classOf[VectorMask[?]])
    )

  /** What a record holds, Ints as raw bits. `A` and `B` are the axes that follow that of the largest
    * component of the direction.
    */
  inline val Record = 16
  inline val Origin = 0
  inline val Inverse = 3
  inline val Limit = 6
  inline val End = 7
  inline val Direction = 8
  inline val ShearA = 11
  inline val ShearB = 12
  inline val Primitive = 13
  inline val Inner = 14

  private inline def plane(b: Array[Float], at: Int, o: FloatVector, i: FloatVector): IntVector =
    FloatVector.broadcast(F, b(at)).sub(o).mul(i).reinterpretAsInts()

  private inline def numbers(of: Array[Float], field: Int, who: Array[Int], at: Int): FloatVector =
    FloatVector.fromArray(F, of, field, who, at)

  /** Appends the rays of a list to those of the children that they hit: the box test of
    * [[VectorKernel]], operation by operation.
    *
    * @param lists  has them from `from` on; child s gets its own from `base` + s · `stride` on
    * @param lanes  of the children in the node, from `first` on, `step` apart
    * @param counts rays of each child
    */
  def expand(
      b: Array[Float],
      width: Int,
      rays: Array[Float],
      lists: Array[Int],
      node: Int,
      from: Int,
      n: Int,
      base: Int,
      stride: Int,
      lanes: Array[Byte],
      first: Int,
      step: Int,
      children: Int,
      counts: Array[Int]
  ): Unit =
    var g = 0
    while g < n do
      val at = from + g
      val who = IntVector.fromArray(I, lists, at)
      val valid = Iota.compare(VectorOperators.LT, n - g)
      val ox = numbers(rays, Origin, lists, at)
      val oy = numbers(rays, Origin + 1, lists, at)
      val oz = numbers(rays, Origin + 2, lists, at)
      val ix = numbers(rays, Inverse, lists, at)
      val iy = numbers(rays, Inverse + 1, lists, at)
      val iz = numbers(rays, Inverse + 2, lists, at)
      val limit = numbers(rays, Limit, lists, at).reinterpretAsInts()
      var s = 0
      while s < children do
        val c = node + lanes(first + s * step)
        val lowX = plane(b, c, ox, ix)
        val highX = plane(b, c + 3 * width, ox, ix)
        val lowY = plane(b, c + width, oy, iy)
        val highY = plane(b, c + 4 * width, oy, iy)
        val lowZ = plane(b, c + 2 * width, oz, iz)
        val highZ = plane(b, c + 5 * width, oz, iz)
        val near = lowX.min(highX).max(lowY.min(highY)).max(lowZ.min(highZ)).max(0)
        val far = lowX
          .max(highX)
          .min(lowY.max(highY))
          .min(lowZ.max(highZ))
          .add(WideWalk.Slack)
          .min(limit)
        val hits = near.compare(VectorOperators.LE, far, valid)
        val count = counts(s)
        val packed: IntVector = Compress.invokeExact(who, hits).asInstanceOf[IntVector]
        packed.intoArray(lists, base + s * stride + count)
        counts(s) = count + hits.trueCount
        s += 1
      g += Lanes

  /** Tests the rays of a list against the triangles of a block, as [[VectorKernel]] does.
    *
    * @param axis of the rays' largest component
    * @param may  set to the bits of the rays, for each triangle of each group: those that pass
    *   inside, and `sure` away those that pass at an edge
    * @return are there any?
    */
  def block(
      t: Array[Float],
      w: Int,
      rays: Array[Float],
      lists: Array[Int],
      corners: Int,
      size: Int,
      from: Int,
      n: Int,
      axis: Int,
      may: Array[Long],
      sure: Int
  ): Boolean =
    val a = if axis == 2 then 0 else axis + 1
    val b = if a == 2 then 0 else a + 1
    val x = corners + a * w
    val y = corners + b * w
    val z = corners + axis * w
    var any = 0L
    var row = 0
    var g = 0
    while g < n do
      val at = from + g
      val valid = Iota.compare(VectorOperators.LT, n - g)
      val ox = numbers(rays, Origin + a, lists, at)
      val oy = numbers(rays, Origin + b, lists, at)
      val oz = numbers(rays, Origin + axis, lists, at)
      val shearX = numbers(rays, ShearA, lists, at)
      val shearY = numbers(rays, ShearB, lists, at)
      val end = numbers(rays, End, lists, at)
        .mul(numbers(rays, Direction + axis, lists, at))
        .mul(WideWalk.Beyond)
      val low = end.min(0f)
      val high = end.max(0f)
      var k = 0
      while k < size do
        val z0 = FloatVector.broadcast(F, t(z + k)).sub(oz)
        val z1 = FloatVector.broadcast(F, t(z + 3 * w + k)).sub(oz)
        val z2 = FloatVector.broadcast(F, t(z + 6 * w + k)).sub(oz)
        val x0 = FloatVector.broadcast(F, t(x + k)).sub(ox).add(z0.mul(shearX))
        val x1 = FloatVector.broadcast(F, t(x + 3 * w + k)).sub(ox).add(z1.mul(shearX))
        val x2 = FloatVector.broadcast(F, t(x + 6 * w + k)).sub(ox).add(z2.mul(shearX))
        val y0 = FloatVector.broadcast(F, t(y + k)).sub(oy).add(z0.mul(shearY))
        val y1 = FloatVector.broadcast(F, t(y + 3 * w + k)).sub(oy).add(z1.mul(shearY))
        val y2 = FloatVector.broadcast(F, t(y + 6 * w + k)).sub(oy).add(z2.mul(shearY))
        val e0 = x1.mul(y2).sub(y1.mul(x2))
        val e1 = x2.mul(y0).sub(y2.mul(x0))
        val e2 = x0.mul(y1).sub(y0.mul(x1))
        val s0 = e0.reinterpretAsInts()
        val s1 = e1.reinterpretAsInts()
        val s2 = e2.reinterpretAsInts()
        val all = e0.mul(e1).mul(e2).reinterpretAsInts().and(Int.MaxValue)
        val zero = all.sub(1).or(Infinities.sub(all))
        val same = s0.or(s1).or(s2).not().or(s0.and(s1).and(s2)).and(zero.not())
        // Neither behind the ray nor past its end
        val pad = z1.sub(z0).abs().add(z2.sub(z0).abs()).mul(WideWalk.Pad)
        val begin = low.sub(pad)
        val stop = high.add(pad)
        val below = z0.sub(begin).reinterpretAsInts()
          .and(z1.sub(begin).reinterpretAsInts())
          .and(z2.sub(begin).reinterpretAsInts())
        val above = stop.sub(z0).reinterpretAsInts()
          .and(stop.sub(z1).reinterpretAsInts())
          .and(stop.sub(z2).reinterpretAsInts())
        val within = below.or(above).not()
        val insideBits = bits(same.and(within).compare(VectorOperators.LT, 0, valid))
        val edgeBits = bits(zero.and(within).compare(VectorOperators.LT, 0, valid))
        may(row) = insideBits
        may(row + sure) = edgeBits
        any |= insideBits | edgeBits
        row += 1
        k += 1
      g += Lanes
    any != 0L

  private inline def bits(m: VectorMask[Integer]): Long = m.toLong

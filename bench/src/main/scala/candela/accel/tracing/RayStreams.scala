package candela.accel.tracing

import candela.accel.{Accelerator, WideTree}
import candela.geometry.{Hit, Ray}
import candela.shapes.TriangleTest

/** Traces many rays at once: each node that some of them reach has their list, and its box and
  * triangle tests take as many rays as a vector has lanes. Few rays go on one by one, by
  * [[VectorKernel]]. Hits are those of all other kernels, bit for bit: vectors repeat the Float tests,
  * and [[TriangleTest]] decides.
  *
  * A stream has rays of one sign and axis of the largest component of the direction. Children are
  * visited in the order of their centres along that axis.
  *
  * @param most   rays at a time
  * @param anyHit whether anything is hit, instead of what is hit first
  */
private[candela] final class RayStreams private (
    tree: WideTree,
    scalar: Accelerator,
    most: Int,
    anyHit: Boolean
):
  import RayStreams.*
  import StreamKernel.*

  private val width = tree.width
  private val lanes = tree.lanes
  private val records = new Array[Float](Record * most)
  private val us, vs = new Array[Double](most)
  private val streams = Array.ofDim[Int](Streams, most)
  private val sizes = new Array[Int](Streams)
  private val order = StreamOrder(tree)

  // Lists of nodes that wait
  private var lists = new Array[Int](64 * most)
  private val codes, starts, counts = new Array[Int](91 * width)
  private val found = new Array[Int](width)
  private val sure = ((most + Lanes - 1) / Lanes) * lanes
  private val may = new Array[Long](2 * sure)

  private val decisions = Decisions(lanes * most)
  private val scratch = Ray()
  private val scratchHit = Hit()
  private val isTame = WideKernel.isTame(tree.bounds)

  /** Rays that went on one by one, and how often. */
  var singles: Long = 0L

  /** Forgets all rays. */
  def clear(): Unit = java.util.Arrays.fill(sizes, 0)

  /** Adds a ray, of which there is one with this number. */
  def add(number: Int, ray: Ray): Unit =
    val at = number * Record
    val r = records
    r(at) = ray.ox
    r(at + 1) = ray.oy
    r(at + 2) = ray.oz
    r(at + Inverse) = ray.invX
    r(at + Inverse + 1) = ray.invY
    r(at + Inverse + 2) = ray.invZ
    r(at + Limit) = java.lang.Float.intBitsToFloat(WideWalk.limitOf(ray.tMax))
    r(at + End) = ray.tMax
    r(at + Direction) = ray.dx
    r(at + Direction + 1) = ray.dy
    r(at + Direction + 2) = ray.dz
    val isBack = ray.dAlongZ < 0f
    r(at + ShearA) = if isBack then ray.shearY else ray.shearX
    r(at + ShearB) = if isBack then ray.shearX else ray.shearY
    setPrimitive(at, -1)
    if isTame && WideKernel.isTame(ray) then
      val stream = 2 * ray.kz + (if isBack then 1 else 0)
      streams(stream)(sizes(stream)) = at
      sizes(stream) += 1
    else
      alone(at, ray.kz, isBack): () =>
        if anyHit then scalar.isOccluded(scratch, scratchHit)
        else scalar.closest(scratch, scratchHit)

  /** Traces all rays. */
  def trace(): Unit =
    var s = 0
    while s < Streams do
      if sizes(s) > 0 then trace(s)
      s += 1

  def isHit(number: Int): Boolean = primitive(number * Record) >= 0

  /** Makes it the ray that was added, but for what only traversals need. */
  def restore(number: Int, ray: Ray): Unit =
    val at = number * Record
    ray.ox = records(at)
    ray.oy = records(at + 1)
    ray.oz = records(at + 2)
    ray.dx = records(at + Direction)
    ray.dy = records(at + Direction + 1)
    ray.dz = records(at + Direction + 2)
    ray.tMax = records(at + End)

  def primitiveOf(number: Int): Int = primitive(number * Record)
  def u(number: Int): Double = us(number)
  def v(number: Int): Double = vs(number)

  /** Writes the ray's direction at `i`. */
  def direction(
      number: Int,
      x: Array[Float],
      y: Array[Float],
      z: Array[Float],
      i: Int
  ): Unit =
    val at = number * Record + Direction
    x(i) = records(at)
    y(i) = records(at + 1)
    z(i) = records(at + 2)

  /** Writes what the ray has met. */
  def read(number: Int, hit: Hit): Unit =
    val at = number * Record
    hit.primitive = primitive(at)
    hit.inner = java.lang.Float.floatToRawIntBits(records(at + Inner))
    hit.u = us(number)
    hit.v = vs(number)

  private def primitive(at: Int): Int =
    java.lang.Float.floatToRawIntBits(records(at + Primitive))

  private def setPrimitive(at: Int, to: Int): Unit =
    records(at + Primitive) = java.lang.Float.intBitsToFloat(to)

  private def trace(stream: Int): Unit =
    val axis = stream >> 1
    val isBack = (stream & 1) != 0
    val n = sizes(stream)
    System.arraycopy(streams(stream), 0, lists, 0, n)
    codes(0) = tree.root
    starts(0) = 0
    counts(0) = n
    var top = 1
    while top > 0 do
      top -= 1
      val code = codes(top)
      val from = starts(top)
      val count = counts(top)
      if count < Few then
        if code != WideTree.NoChild then single(code, from, count, axis, isBack)
      else if code >= 0 then top = expand(code, from, count, top, axis, isBack)
      else if WideTree.isBlock(code) then block(code, from, count, axis, isBack)
      else if code != WideTree.NoChild then others(code, from, count, axis, isBack)

  /** Pushes the children that rays hit, the nearest last. */
  private def expand(
      node: Int,
      from: Int,
      n: Int,
      top: Int,
      axis: Int,
      isBack: Boolean
  ): Int =
    val base = from + n + Lanes
    val stride = n + Lanes
    val children = order.children(node)
    if base + children * stride + Lanes > lists.length then
      lists = java.util.Arrays.copyOf(lists, 2 * (base + children * stride + Lanes))
    java.util.Arrays.fill(found, 0)
    val lanesFrom = order.begin(node, axis) + (if isBack then 0 else children - 1)
    val step = if isBack then 1 else -1
    StreamKernel.expand(
      tree.nodes,
      width,
      records,
      lists,
      node,
      from,
      n,
      base,
      stride,
      order.lanes,
      lanesFrom,
      step,
      children,
      found
    )
    var pushed = top
    var s = 0
    while s < children do
      if found(s) > 0 then
        val child = node + 6 * width + order.lanes(lanesFrom + s * step)
        codes(pushed) = java.lang.Float.floatToRawIntBits(tree.nodes(child))
        starts(pushed) = base + s * stride
        counts(pushed) = found(s)
        pushed += 1
      s += 1
    pushed

  private def block(code: Int, from: Int, n: Int, axis: Int, isBack: Boolean): Unit =
    val corners = WideTree.first(code) * WideTree.blockFloats(lanes)
    val size = WideTree.size(code)
    val any = StreamKernel.block(
      tree.blocks, lanes, records, lists, corners, size, from, n, axis, may, sure
    )
    if any then
      var row = 0
      var g = 0
      val d = decisions
      d.count = 0
      while g < n do
        var k = 0
        while k < size do
          collect(may(row), from + g, corners + k)
          decide(may(row + sure), from + g, corners + k, axis, isBack)
          row += 1
          k += 1
        g += Lanes
      DecisionKernel.decide(d, tree.blocks, lanes, records)
      var i = 0
      while i < d.count do
        settle(d, i, axis, isBack)
        i += 1

  /** Lists the rays whose bits are set, which pass inside a triangle. */
  private def collect(bits: Long, from: Int, triangle: Int): Unit =
    val d = decisions
    var left = bits
    while left != 0L do
      d.ray(d.count) = lists(from + java.lang.Long.numberOfTrailingZeros(left))
      d.triangle(d.count) = triangle
      d.count += 1
      left &= left - 1

  /** Decides by what [[DecisionKernel]] has computed. */
  private def settle(d: Decisions, i: Int, axis: Int, isBack: Boolean): Unit =
    val at = d.ray(i)
    val triangle = d.triangle(i)
    val owner = java.lang.Float.floatToRawIntBits(tree.blocks(triangle + 9 * lanes))
    if d.clear(i) >= 0L then decide(at, triangle, owner, axis, isBack)
    else if isWanted(at) then
      val end = d.t(i)
      val old = records(at + End)
      val own = if anyHit then Int.MaxValue else owner
      if end > 0f && end <= old && pair(end, own) < pair(old, primitive(at)) then
        keep(at, end, owner, d.b1(i), d.b2(i))

  private inline def pair(t: Float, primitive: Int): Long =
    (java.lang.Float.floatToRawIntBits(t).toLong << 32) + (primitive.toLong - Int.MinValue)

  /** Decides about one triangle and the rays whose bits are set, by scalar code. */
  private def decide(bits: Long, from: Int, triangle: Int, axis: Int, isBack: Boolean): Unit =
    if bits != 0L then
      val owner = java.lang.Float.floatToRawIntBits(tree.blocks(triangle + 9 * lanes))
      var left = bits
      while left != 0L do
        val at = lists(from + java.lang.Long.numberOfTrailingZeros(left))
        decide(at, triangle, owner, axis, isBack)
        left &= left - 1

  private def decide(at: Int, triangle: Int, owner: Int, axis: Int, isBack: Boolean): Unit =
    alone(at, axis, isBack): () =>
      val isHit =
        if anyHit then TriangleTest.isHit(tree.blocks, triangle, lanes, scratch, scratchHit)
        else TriangleTest.intersect(tree.blocks, triangle, lanes, owner, scratch, scratchHit)
      if isHit then scratchHit.primitive = owner
      isHit

  private def others(code: Int, from: Int, n: Int, axis: Int, isBack: Boolean): Unit =
    val first = WideTree.first(code)
    val end = first + WideTree.size(code)
    var i = from
    while i < from + n do
      alone(lists(i), axis, isBack): () =>
        if anyHit then tree.others.isHit(first, end, scratch, scratchHit)
        else tree.others.intersect(first, end, scratch, scratchHit)
      i += 1

  /** Goes on with rays one by one. */
  private def single(code: Int, from: Int, n: Int, axis: Int, isBack: Boolean): Unit =
    val below = WideTree(
      width,
      lanes,
      tree.count,
      tree.bounds,
      tree.nodes,
      code,
      tree.blocks,
      tree.others
    )
    singles += n
    var i = from
    while i < from + n do
      alone(lists(i), axis, isBack): () =>
        if anyHit then VectorKernel.isOccluded(below, scratch, scratchHit)
        else VectorKernel.closest(below, scratch, scratchHit)
      i += 1

  /** Does the ray still ask? Not for any hit, once it has one. */
  private def isWanted(at: Int): Boolean = !(anyHit && primitive(at) >= 0)

  /** Traces one ray, the scratch ray, by scalar code, and keeps what it hits. */
  private inline def alone(at: Int, axis: Int, isBack: Boolean)(inline isHit: () => Boolean): Unit =
    if isWanted(at) then
      load(at, axis, isBack)
      if isHit() then
        records(at + Inner) = java.lang.Float.intBitsToFloat(scratchHit.inner)
        keep(at, scratch.tMax, scratchHit.primitive, scratchHit.u, scratchHit.v)

  private def keep(at: Int, end: Float, owner: Int, u: Double, v: Double): Unit =
    if anyHit then
      setPrimitive(at, 0)
      records(at + Limit) = Ended
    else
      records(at + End) = end
      records(at + Limit) = java.lang.Float.intBitsToFloat(WideWalk.limitOf(end))
      setPrimitive(at, owner)
      us(at / Record) = u
      vs(at / Record) = v

  /** Makes the scratch ray and its hit those of a record, as [[Ray.set]] does. */
  private def load(at: Int, axis: Int, isBack: Boolean): Unit =
    val r = records
    val ray = scratch
    restore(at / Record, ray)
    ray.invX = r(at + Inverse)
    ray.invY = r(at + Inverse + 1)
    ray.invZ = r(at + Inverse + 2)
    val a = if axis == 2 then 0 else axis + 1
    val b = if a == 2 then 0 else a + 1
    ray.kz = axis
    ray.kx = if isBack then b else a
    ray.ky = if isBack then a else b
    ray.shearX = r(at + (if isBack then ShearB else ShearA))
    ray.shearY = r(at + (if isBack then ShearA else ShearB))
    ray.shearZ = r(at + Inverse + axis)
    ray.oAlongX = r(at + ray.kx)
    ray.oAlongY = r(at + ray.ky)
    ray.oAlongZ = r(at + axis)
    ray.dAlongZ = r(at + Direction + axis)
    read(at / Record, scratchHit)

private[candela] object RayStreams:
  /** Rays below which they go on one by one. */
  private val Few = Integer.getInteger("candela.lanes.few", 4).intValue

  /** Three axes, two signs. */
  private inline val Streams = 6

  /** A limit that no box begins before. */
  private val Ended = java.lang.Float.intBitsToFloat(Int.MinValue)

  /** None if the scene has no hierarchy for vectors, or the JVM none. */
  def of(accelerator: Accelerator, most: Int, anyHit: Boolean): Option[RayStreams] =
    accelerator match
      case b: WideBvh if Hierarchies.hasVectors && b.tree.lanes == VectorKernel.lanes =>
        Some(new RayStreams(b.tree, accelerator, most, anyHit))
      case _ => None

/** The children of each node in the order of their centres, along each axis. */
private[tracing] final class StreamOrder(tree: WideTree):
  private val width = tree.width
  private val floats = WideTree.floats(width)
  private val counts = new Array[Byte](tree.nodes.length / floats)

  /** Lanes of children: `width` for each axis of each node. */
  val lanes: Array[Byte] = new Array[Byte](counts.length * 3 * width)

  for i <- counts.indices do
    val node = i * floats
    val used = (0 until width).filter: k =>
      java.lang.Float.floatToRawIntBits(tree.nodes(node + 6 * width + k)) != WideTree.NoChild
    counts(i) = used.length.toByte
    for axis <- 0 until 3 do
      def centre(k: Int) =
        tree.nodes(node + axis * width + k) + tree.nodes(node + (3 + axis) * width + k)
      val sorted = used.sortBy(centre)
      for (k, at) <- sorted.zipWithIndex do lanes((i * 3 + axis) * width + at) = k.toByte

  def children(node: Int): Int = counts(node / floats)
  def begin(node: Int, axis: Int): Int = (node / floats * 3 + axis) * width

package candela.photons

import candela.base.loop
import candela.concurrency.GivenUp
import candela.geometry.Ray
import candela.math.*

/** The photons of one pass that arrived in media, or some of them. Immutable.
  *
  * A binary tree of boxes over photons in Morton order, whose leaves all have the same number of
  * photons: node k has the children 2k and 2k + 1.
  *
  * @param parts     photons in accumulation order, those at surfaces among them
  * @param paths     number of light paths traced for them
  * @param radius    within which a ray finds photons
  * @param every     one in how many of them is taken
  * @param first     the first of these: below `every`, and each equally often, lest few have the
  *   wrong mean
  * @param isStopped whether nobody waits for it any more, which is a GivenUp
  */
private[candela] final class PhotonTree(
    parts: Array[Photons],
    paths: Int,
    radius: Float,
    every: Int = 1,
    first: Int = 0,
    isStopped: () => Boolean = GivenUp.Never
):
  import PhotonMap.Numbers
  import PhotonTree.*

  val count: Int =
    val total = parts.foldLeft(0)((n, p) => Math.addExact(n, p.inMedia))
    (total - first + every - 1) / every

  /** Power of a photon to that per area across a ray that finds it. */
  val perArea: Float = every / (Pi * square(radius) * paths)

  /** The photons, [[PhotonMap.Numbers]] each. */
  val data: Array[Float] = new Array[Float](Math.multiplyExact(count, Numbers))

  /** Their positions again, close together: most photons of the leaves that a ray meets are beyond
    * the radius, and memory is what a search waits for.
    */
  private val positions = new Array[Float](3 * count)

  /** A power of two, so that all leaves have the same depth; the last may be empty. */
  private val leafCount =
    Integer.highestOneBit(Math.max(1, 2 * ((count + OfLeaf - 1) / OfLeaf) - 1))
  private val boxes = new Array[Float](2 * leafCount * 6)
  if count > 0 then
    sort()
    enclose()

  private def sort(): Unit =
    val photons = new Array[Float](data.length)
    var offset = 0
    var skipped = every - 1 - first
    for part <- parts do
      GivenUp.check(isStopped)
      loop(part.count): i =>
        if part.data(i * Numbers + PhotonMap.PlaceOffset) >= 0f then
          skipped += 1
          if skipped == every then
            System.arraycopy(part.data, i * Numbers, photons, offset, Numbers)
            offset += Numbers
            skipped = 0
    val low = Array.fill(3)(Float.PositiveInfinity)
    val high = Array.fill(3)(Float.NegativeInfinity)
    loop(count): i =>
      loop(3): k =>
        low(k) = Math.min(low(k), photons(i * Numbers + k))
        high(k) = Math.max(high(k), photons(i * Numbers + k))
    val forIndex = 64 - java.lang.Long.numberOfLeadingZeros(count - 1L)
    val bits = Math.min(MortonBits, (63 - forIndex) / 3)
    val cells = (1 << bits).toDouble
    val keys = new Array[Long](count)
    loop(count): i =>
      var morton = 0L
      loop(3): k =>
        val extent = high(k).toDouble - low(k)
        val coordinate =
          if extent > 0.0 then (photons(i * Numbers + k) - low(k)) / extent * cells else 0.0
        morton |= spread(Math.min(coordinate.toLong, (1L << bits) - 1)) << k
      keys(i) = morton << forIndex | i
    GivenUp.check(isStopped)
    java.util.Arrays.sort(keys)
    val index = (1L << forIndex) - 1
    loop(count): i =>
      System.arraycopy(photons, (keys(i) & index).toInt * Numbers, data, i * Numbers, Numbers)
      System.arraycopy(data, i * Numbers, positions, 3 * i, 3)

  private def enclose(): Unit =
    var node = 2 * leafCount - 1
    while node > 0 do
      GivenUp.check(isStopped, node)
      val box = node * 6
      loop(3): k =>
        var low = Float.PositiveInfinity
        var high = Float.NegativeInfinity
        if node < leafCount then
          low = Math.min(boxes(2 * box + k), boxes(2 * box + 6 + k))
          high = Math.max(boxes(2 * box + 3 + k), boxes(2 * box + 9 + k))
        else
          loop(start(node), end(node)): i =>
            low = Math.min(low, positions(3 * i + k))
            high = Math.max(high, positions(3 * i + k))
        boxes(box + k) = low
        boxes(box + 3 + k) = high
      node -= 1

  /** Of the photons of a leaf. */
  private def start(node: Int): Int = Math.min((node - leafCount) * OfLeaf, count)
  private def end(node: Int): Int = Math.min((node - leafCount + 1) * OfLeaf, count)

  /** Finds the photons around a ray, in the order in which it passes them.
    *
    * @param medium that the photons have arrived in
    * @param most   leaves out photons whose paths have more edges
    */
  def query(ray: Ray, medium: Int, most: Int, out: PassedPhotons): Unit =
    out.clear()
    if count > 0 then
      val stack = out.stack
      var top = 1
      stack(0) = 1
      while top > 0 do
        top -= 1
        val node = stack(top)
        if passes(ray, node) then
          if node >= leafCount then searchLeaf(ray, node, medium.toFloat, most.toFloat, out)
          else
            stack(top) = 2 * node + 1
            stack(top + 1) = 2 * node
            top += 2
      out.sort()

  /** Does the ray come within the radius of the box, if the node has photons? */
  private[candela] def passes(ray: Ray, node: Int): Boolean =
    val box = node * 6
    val x1 = (boxes(box) - radius - ray.ox) * ray.invX
    val x2 = (boxes(box + 3) + radius - ray.ox) * ray.invX
    val y1 = (boxes(box + 1) - radius - ray.oy) * ray.invY
    val y2 = (boxes(box + 4) + radius - ray.oy) * ray.invY
    val z1 = (boxes(box + 2) - radius - ray.oz) * ray.invZ
    val z2 = (boxes(box + 5) + radius - ray.oz) * ray.invZ
    val near = Math.max(Math.max(Math.min(x1, x2), Math.min(y1, y2)), Math.min(z1, z2))
    val far = Math.min(Math.min(Math.max(x1, x2), Math.max(y1, y2)), Math.max(z1, z2))
    // Comparisons with NaN, of a ray along a side, are false
    boxes(box) <= boxes(box + 3) && !(near > far || far < 0f || near > ray.tMax)

  private def searchLeaf(
      ray: Ray,
      node: Int,
      medium: Float,
      most: Float,
      out: PassedPhotons
  ): Unit =
    val perSquare = 1f / (square(ray.dx) + square(ray.dy) + square(ray.dz))
    val radius2 = square(radius)
    var i = start(node)
    val last = end(node)
    while i < last do
      val x = positions(3 * i) - ray.ox
      val y = positions(3 * i + 1) - ray.oy
      val z = positions(3 * i + 2) - ray.oz
      val t = (x * ray.dx + y * ray.dy + z * ray.dz) * perSquare
      val beside2 = square(x - t * ray.dx) + square(y - t * ray.dy) + square(z - t * ray.dz)
      if beside2 < radius2 && t > 0f && t < ray.tMax then
        val offset = i * Numbers
        val isTaken = data(offset + PhotonMap.PlaceOffset) == medium &&
          Math.abs(data(offset + PhotonMap.EdgesOffset)) <= most
        if isTaken then out.add(t, offset)
      i += 1

private object PhotonTree:
  /** Photons of a leaf. */
  private inline val OfLeaf = 8

  /** Most digits of a coordinate. */
  private inline val MortonBits = 21

  /** Moves the digits of a number apart, two zeros between each. */
  private def spread(x: Long): Long =
    var s = x
    s = (s | s << 32) & 0x1f00000000ffffL
    s = (s | s << 16) & 0x1f0000ff0000ffL
    s = (s | s << 8) & 0x100f00f00f00f00fL
    s = (s | s << 4) & 0x10c30c30c30c30c3L
    (s | s << 2) & 0x1249249249249249L

/** Photons that a ray passes, by their distance. Mutable, one per worker. */
private[candela] final class PassedPhotons:
  private var keys = new Array[Long](256)
  private[candela] val stack = new Array[Int](PassedPhotons.Deepest)

  var count: Int = 0

  private[candela] def clear(): Unit = count = 0

  private[candela] def add(t: Float, offset: Int): Unit =
    if count == keys.length then keys = java.util.Arrays.copyOf(keys, 2 * count)
    keys(count) = java.lang.Float.floatToRawIntBits(t).toLong << 32 | offset
    count += 1

  private[candela] def sort(): Unit = java.util.Arrays.sort(keys, 0, count)

  /** Parameter of the ray next to photon `i`. */
  def t(i: Int): Float = java.lang.Float.intBitsToFloat((keys(i) >>> 32).toInt)

  /** Where its numbers begin in the map's data. */
  def offset(i: Int): Int = keys(i).toInt

private[candela] object PassedPhotons:
  /** Nodes that wait in a traversal, at most: one for each level of a tree, and one more. */
  private inline val Deepest = 34

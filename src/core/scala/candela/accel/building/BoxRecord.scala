package candela.accel.building

import candela.concurrency.Parallel
import candela.accel.Primitives
import candela.shapes.TriangleSoup

/** A primitive's box as sorted by the BVH builder: eight Ints, of which 0 to 2 are −min x, y, z, 4
  * to 6 are max x, y, z, and 3 is the primitive's number.
  *
  * Coordinates are Ints in the same order as their Floats, and minima are negated: a union is six
  * integer maxima, which compile without branches. Float comparisons are branches, mispredicted
  * while a box still grows, and `math.max` on Floats handles NaN and −0 (docs/decisions/0012).
  */
private[building] object BoxRecord:
  inline val Ints = 8

  /** Offset of the primitive's number. */
  inline val Number = 3

  /** Offset from −min to max of the same axis. */
  inline val High = 4

  /** −∞, encoded: each coordinate of an empty box. */
  inline val MinusInfinity = -2139095041

  inline def encode(x: Float): Int =
    val bits = java.lang.Float.floatToRawIntBits(x)
    bits ^ ((bits >> 31) & 0x7fffffff)

  inline def decode(i: Int): Float =
    java.lang.Float.intBitsToFloat(i ^ ((i >> 31) & 0x7fffffff))

  /** Twice the centroid along an axis. */
  inline def middle(records: Array[Int], at: Int, axis: Int): Float =
    decode(records(at + High + axis)) - decode(records(at + axis))

  inline def side(box: Array[Int], at: Int, axis: Int): Float =
    decode(box(at + High + axis)) + decode(box(at + axis))

  def halfArea(box: Array[Int], at: Int): Float =
    halfArea(box(at), box(at + 1), box(at + 2), box(at + 4), box(at + 5), box(at + 6))

  inline def halfArea(
      lowX: Int,
      lowY: Int,
      lowZ: Int,
      highX: Int,
      highY: Int,
      highZ: Int
  ): Float =
    val x = decode(highX) + decode(lowX)
    val y = decode(highY) + decode(lowY)
    val z = decode(highZ) + decode(lowZ)
    x * y + y * z + z * x

  def clear(box: Array[Int], at: Int): Unit =
    java.util.Arrays.fill(box, at, at + Ints, MinusInfinity)

  inline def grow(box: Array[Int], at: Int, by: Array[Int], from: Int): Unit =
    box(at) = Math.max(box(at), by(from))
    box(at + 1) = Math.max(box(at + 1), by(from + 1))
    box(at + 2) = Math.max(box(at + 2), by(from + 2))
    box(at + 4) = Math.max(box(at + 4), by(from + 4))
    box(at + 5) = Math.max(box(at + 5), by(from + 5))
    box(at + 6) = Math.max(box(at + 6), by(from + 6))

  /** Union with branches: faster if the box already contains most of what is added. */
  inline def growRarely(box: Array[Int], at: Int, by: Array[Int], from: Int): Unit =
    if by(from) > box(at) then box(at) = by(from)
    if by(from + 1) > box(at + 1) then box(at + 1) = by(from + 1)
    if by(from + 2) > box(at + 2) then box(at + 2) = by(from + 2)
    if by(from + 4) > box(at + 4) then box(at + 4) = by(from + 4)
    if by(from + 5) > box(at + 5) then box(at + 5) = by(from + 5)
    if by(from + 6) > box(at + 6) then box(at + 6) = by(from + 6)

  /** Stores the union of records[first, end) in a box. */
  def uniteInto(box: Array[Int], at: Int, records: Array[Int], first: Int, end: Int): Unit =
    var lowX, lowY, lowZ, highX, highY, highZ = MinusInfinity
    var i = first * Ints
    while i < end * Ints do
      lowX = Math.max(lowX, records(i))
      lowY = Math.max(lowY, records(i + 1))
      lowZ = Math.max(lowZ, records(i + 2))
      highX = Math.max(highX, records(i + 4))
      highY = Math.max(highY, records(i + 5))
      highZ = Math.max(highZ, records(i + 6))
      i += Ints
    box(at) = lowX
    box(at + 1) = lowY
    box(at + 2) = lowZ
    box(at + 4) = highX
    box(at + 5) = highY
    box(at + 6) = highZ

  inline def copy(from: Array[Int], at: Int, to: Array[Int], toAt: Int): Unit =
    to(toAt) = from(at)
    to(toAt + 1) = from(at + 1)
    to(toAt + 2) = from(at + 2)
    to(toAt + 3) = from(at + 3)
    to(toAt + 4) = from(at + 4)
    to(toAt + 5) = from(at + 5)
    to(toAt + 6) = from(at + 6)

  def write(
      to: Array[Int],
      at: Int,
      number: Int,
      minX: Float,
      minY: Float,
      minZ: Float,
      maxX: Float,
      maxY: Float,
      maxZ: Float
  ): Unit =
    to(at) = encode(-minX)
    to(at + 1) = encode(-minY)
    to(at + 2) = encode(-minZ)
    to(at + Number) = number
    to(at + 4) = encode(maxX)
    to(at + 5) = encode(maxY)
    to(at + 6) = encode(maxZ)

  /** Decodes to six Floats: min x, y, z, max x, y, z. */
  def read(box: Array[Int], at: Int, to: Array[Float], toAt: Int): Unit =
    to(toAt) = -decode(box(at))
    to(toAt + 1) = -decode(box(at + 1))
    to(toAt + 2) = -decode(box(at + 2))
    to(toAt + 3) = decode(box(at + 4))
    to(toAt + 4) = decode(box(at + 5))
    to(toAt + 5) = decode(box(at + 6))

  /** Records of all primitives. */
  def ofAll(primitives: Primitives, parallel: Parallel): Array[Int] =
    collected(primitives, primitives.count, i => i, parallel)

  /** Records of some. */
  def ofSome(primitives: Primitives, indices: Array[Int], parallel: Parallel): Array[Int] =
    collected(primitives, indices.length, indices(_), parallel)

  private inline def collected(
      primitives: Primitives,
      count: Int,
      inline which: Int => Int,
      parallel: Parallel
  ): Array[Int] =
    val soup = primitives.soup
    val records = new Array[Int](Math.multiplyExact(Ints, count))
    parallel.ranges(count): (from, until) =>
      val b = new Array[Float](6)
      var slot = from
      while slot < until do
        val offset = Ints * slot
        val i = which(slot)
        if i < soup.count then writeTriangle(records, offset, soup, i)
        else
          primitives.writeBounds(b, 0, i)
          write(records, offset, i, b(0), b(1), b(2), b(3), b(4), b(5))
        slot += 1
    records

  private def writeTriangle(to: Array[Int], at: Int, soup: TriangleSoup, triangle: Int): Unit =
    val p = soup.positions
    val a = 3 * soup.indices(3 * triangle)
    val b = 3 * soup.indices(3 * triangle + 1)
    val c = 3 * soup.indices(3 * triangle + 2)
    var axis = 0
    while axis < 3 do
      val x = p(a + axis)
      val y = p(b + axis)
      val z = p(c + axis)
      val low = if x < y then if x < z then x else z else if y < z then y else z
      val high = if x > y then if x > z then x else z else if y > z then y else z
      to(at + axis) = encode(-low)
      to(at + High + axis) = encode(high)
      axis += 1
    to(at + Number) = triangle

package candela.math

import candela.base.loop

/** Static affine maps, of which there may be millions: of each three rows of its inverse, by which
  * rays enter, in chunks. The map itself is computed from these when it is asked for, and is the
  * given one but for the rounding of Doubles.
  */
final class MotionRows:
  import MotionRows.*

  private var chunks = new Array[Array[Double]](1)
  private var size = 0

  def count: Int = size

  /** Adds a map that [[canHold]] accepts, and returns its number. */
  def add(map: Transform): Int =
    val i = grow()
    val (to, at) = (chunks(chunk(i)), start(i))
    loop(Doubles)(k => to(at + k) = map.inverseM(k))
    i

  /** Sets the map `i` by the numbers of a [[Motion]]. */
  def store(i: Int, numbers: Array[Double]): Unit =
    System.arraycopy(numbers, Doubles, chunks(chunk(i)), start(i), Doubles)

  /** Adds room for a map, and returns its number. */
  def grow(): Int =
    val last = chunk(size)
    if last == chunks.length then chunks = java.util.Arrays.copyOf(chunks, 2 * last)
    if start(size) == 0 then chunks(last) = new Array[Double](Doubles << Bits)
    size += 1
    size - 1

  /** The same maps, behind which others can be added; all chunks that are full are shared. */
  def continued: MotionRows =
    val next = MotionRows()
    next.chunks = chunks.clone
    next.size = size
    val last = chunk(size)
    if start(size) > 0 then next.chunks(last) = chunks(last).clone
    next

  /** All numbers so far: those of the inverse of map `i` are in `all(chunk(i))`, from [[start]] on.
    */
  def numbers: Array[Array[Double]] = chunks

  /** The map `i`; its inverse has every bit. */
  def transform(i: Int): Transform =
    val numbers = new Array[Double](Motion.Doubles)
    write(chunks(chunk(i)), start(i), numbers, 0)
    Transform.affine(numbers, 0)

object MotionRows:
  private inline val Bits = 8

  /** Numbers of each. */
  inline val Doubles = 12

  /** Error of an inverse by cofactors, relative to the map, which one step of Newton's method
    * reduces to the rounding of Doubles, or nearly.
    */
  private inline val LargestError = 1e-7

  /** The chunk of the map `i`. */
  inline def chunk(i: Int): Int = i >> Bits

  /** Where its numbers begin in the chunk. */
  inline def start(i: Int): Int = (i & ((1 << Bits) - 1)) * Doubles

  /** Writes a map and its inverse, as a [[Motion]] does.
    *
    * @param rows has those of the inverse, from `from` on
    */
  def write(rows: Array[Double], from: Int, to: Array[Double], at: Int): Unit =
    System.arraycopy(rows, from, to, at + Doubles, Doubles)
    invert(rows, from, to, at): Unit

  /** Whether the map and its inverse are affine to the last bit, and the inverse tells the map. */
  def canHold(map: Transform): Boolean =
    isAffine(map.m) && isAffine(map.inverseM) &&
      isRegular(Array.tabulate(Doubles)(map.inverseM(_)), 0)

  /** As above, of the numbers of a [[Motion]]. */
  def canHold(numbers: Array[Double]): Boolean = isRegular(numbers, Doubles)

  private def isRegular(rows: Array[Double], from: Int): Boolean =
    invert(rows, from, new Array[Double](Doubles), 0) <= LargestError

  private def isAffine(m: IArray[Double]): Boolean =
    def isExactly(i: Int, x: Double) =
      java.lang.Double.doubleToRawLongBits(m(i)) == java.lang.Double.doubleToRawLongBits(x)
    isExactly(12, 0) && isExactly(13, 0) && isExactly(14, 0) && isExactly(15, 1)

  /** Writes the inverse of a map, three rows.
    *
    * @return the error that was corrected; NaN or infinite if the map is singular
    */
  private def invert(m: Array[Double], from: Int, to: Array[Double], at: Int): Double =
    adjugate(m, from, to, at)
    val scale = 1 / (m(from) * to(at) + m(from + 1) * to(at + 4) + m(from + 2) * to(at + 8))
    // No zero is −0
    loop(Doubles)(k => to(at + k) = to(at + k) * scale + 0.0)
    val error = refine(m, from, to, at)
    loop(3): r =>
      val k = at + 4 * r
      to(k + 3) = 0.0 -
        (to(k) * m(from + 3) + to(k + 1) * m(from + 7) + to(k + 2) * m(from + 11))
    error

  private def adjugate(m: Array[Double], from: Int, to: Array[Double], at: Int): Unit =
    inline def minor(a: Int, b: Int, c: Int, d: Int) =
      m(from + a) * m(from + b) - m(from + c) * m(from + d)
    to(at) = minor(5, 10, 6, 9)
    to(at + 1) = minor(2, 9, 1, 10)
    to(at + 2) = minor(1, 6, 2, 5)
    to(at + 4) = minor(6, 8, 4, 10)
    to(at + 5) = minor(0, 10, 2, 8)
    to(at + 6) = minor(2, 4, 0, 6)
    to(at + 8) = minor(4, 9, 5, 8)
    to(at + 9) = minor(1, 8, 0, 9)
    to(at + 10) = minor(0, 5, 1, 4)

  /** A step of Newton's method towards the inverse: D + D (1 − M D), column by column. */
  private def refine(m: Array[Double], from: Int, to: Array[Double], at: Int): Double =
    var largest = 0.0
    loop(3): c =>
      val x = to(at + c)
      val y = to(at + 4 + c)
      val z = to(at + 8 + c)
      inline def residual(r: Int) =
        val k = from + 4 * r
        (if r == c then 1.0 else 0.0) - (m(k) * x + m(k + 1) * y + m(k + 2) * z)
      val rx = residual(0)
      val ry = residual(1)
      val rz = residual(2)
      loop(3): r =>
        val k = at + 4 * r
        to(k + c) += to(k) * rx + to(k + 1) * ry + to(k + 2) * rz
      largest = Math.max(largest, Math.max(Math.abs(rx), Math.max(Math.abs(ry), Math.abs(rz))))
    largest

/** A static map, one of many. */
final class MotionRow(val rows: MotionRows, val row: Int) extends Motion:
  override def moves: Boolean = false
  def rotationRate(leastAngle: Double): Double = 0
  def write(time: Float, to: Array[Double], at: Int): Unit =
    MotionRows.write(rows.numbers(MotionRows.chunk(row)), MotionRows.start(row), to, at)

package candela.math

/** Static affine maps with their inverses, as a [[Motion]] writes them: [[Motion.Doubles]] numbers
  * each, in chunks. There may be millions.
  */
final class MotionRows:
  import MotionRows.*

  private var chunks = new Array[Array[Double]](1)
  private var size = 0

  def count: Int = size

  /** Adds room for a map, and returns its number. */
  def grow(): Int =
    val chunk = size >> Bits
    if chunk == chunks.length then chunks = java.util.Arrays.copyOf(chunks, 2 * chunk)
    if start(size) == 0 then chunks(chunk) = new Array[Double](Motion.Doubles << Bits)
    size += 1
    size - 1

  /** Adds a map that [[canHold]] accepts, and returns its number. */
  def add(map: Transform): Int =
    val i = grow()
    Motion.put(map, chunks(i >> Bits), start(i))
    i

  /** The same maps, behind which others can be added; all chunks that are full are shared. */
  def continued: MotionRows =
    val next = MotionRows()
    next.chunks = chunks.clone
    next.size = size
    val last = chunk(size)
    if start(size) > 0 then next.chunks(last) = chunks(last).clone
    next

  /** All numbers so far: those of map `i` are in `all(chunk(i))`, from [[start]] on. */
  def all: Array[Array[Double]] = chunks

  /** The map `i`, with every bit. */
  def transform(i: Int): Transform = Transform.affine(chunks(chunk(i)), start(i))

object MotionRows:
  private inline val Bits = 8

  /** The chunk of the map `i`. */
  inline def chunk(i: Int): Int = i >> Bits

  /** Where its numbers begin in the chunk. */
  inline def start(i: Int): Int = (i & ((1 << Bits) - 1)) * Motion.Doubles

  /** Whether the map and its inverse are affine to the last bit. */
  def canHold(map: Transform): Boolean = isAffine(map.m) && isAffine(map.inverseM)

  private def isAffine(m: IArray[Double]): Boolean =
    def is(i: Int, x: Double) =
      java.lang.Double.doubleToRawLongBits(m(i)) == java.lang.Double.doubleToRawLongBits(x)
    is(12, 0) && is(13, 0) && is(14, 0) && is(15, 1)

/** A static map, one of many. */
final class MotionRow(val rows: MotionRows, val row: Int) extends Motion:
  override def moves: Boolean = false
  def write(time: Float, to: Array[Double], at: Int): Unit =
    val from = rows.all(MotionRows.chunk(row))
    System.arraycopy(from, MotionRows.start(row), to, at, Motion.Doubles)

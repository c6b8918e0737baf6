package candela.math

/** A time-dependent affine map.
  *
  * Stored as [[Motion.Doubles]] numbers: the first three rows of the map, then the first three of
  * its inverse, so that transforming a ray does not allocate.
  */
abstract class Motion:

  /** Writes the map at `time` to `to`, from `at` on. Animated maps may use the rest of the
    * [[Motion.Work]] numbers as scratch memory.
    */
  def write(time: Float, to: Array[Double], at: Int): Unit

  def moves: Boolean = true

  /** How fast it rotates, at most, in radians per unit of time.
    *
    * @param leastAngle by which an interpolation counts as rotating, because something else is not
    *   linear in time
    */
  def rotationRate(leastAngle: Double = 0): Double

  /** The map at `time` as an object, for infrequent use. */
  final def transform(time: Float): Transform =
    val rows = new Array[Double](Motion.Work)
    write(time, rows, 0)
    Transform.fromRows(rows.take(12).toIndexedSeq ++ Vector(0.0, 0.0, 0.0, 1.0)).get

object Motion:
  inline val Doubles = 24
  inline val Work = 72

  private[math] def writeRows(t: Transform, to: Array[Double], at: Int): Unit =
    var k = 0
    while k < 12 do
      to(at + k) = t.m(k)
      to(at + 12 + k) = t.inverseM(k)
      k += 1

/** A static map. */
final class Still(map: Transform) extends Motion:
  def write(time: Float, to: Array[Double], at: Int): Unit = Motion.writeRows(map, to, at)
  override def moves: Boolean = false
  def rotationRate(leastAngle: Double): Double = 0

/** The inverse of another motion, which may differ from interpolating the inverses. */
final class InverseMotion(of: Motion) extends Motion:
  override def moves: Boolean = of.moves
  def rotationRate(leastAngle: Double): Double = of.rotationRate(Math.max(leastAngle, Math.PI))
  def write(time: Float, to: Array[Double], at: Int): Unit =
    of.write(time, to, at)
    var k = at
    while k < at + 12 do
      val swap = to(k)
      to(k) = to(k + 12)
      to(k + 12) = swap
      k += 1

/** Applies `inner`, then `outer`; neither is a product itself. */
final class MotionProduct(outer: Motion, inner: Motion) extends Motion:
  override def moves: Boolean = outer.moves || inner.moves
  def rotationRate(leastAngle: Double): Double =
    outer.rotationRate(leastAngle) + inner.rotationRate(leastAngle)
  def write(time: Float, to: Array[Double], at: Int): Unit =
    val a = at + Motion.Doubles
    val b = a + Motion.Doubles
    outer.write(time, to, a)
    inner.write(time, to, b)
    product(to, a, b, at)
    product(to, b + 12, a + 12, at + 12)

  /** Product of three rows each. */
  private def product(m: Array[Double], a: Int, b: Int, at: Int): Unit =
    var r = 0
    while r < 12 do
      var c = 0
      while c < 4 do
        val sum = m(a + r) * m(b + c) + m(a + r + 1) * m(b + 4 + c) + m(a + r + 2) * m(b + 8 + c)
        m(at + r + c) = if c == 3 then sum + m(a + r + 3) else sum
        c += 1
      r += 4

/** A motion between spaces whose origins lie elsewhere.
  *
  * @param from the new origin, in the space that `motion` maps from
  * @param to   the new origin, in the space that it maps to
  */
final class RecentredMotion(motion: Motion, from: Position, to: Position) extends Motion:
  override def moves: Boolean = motion.moves
  def rotationRate(leastAngle: Double): Double = motion.rotationRate(leastAngle)
  def write(time: Float, rows: Array[Double], at: Int): Unit =
    motion.write(time, rows, at)
    recentre(rows, at, from, to)
    recentre(rows, at + 12, to, from)

  private def recentre(m: Array[Double], at: Int, from: Position, to: Position): Unit =
    m(at + 3) += m(at) * from.x + m(at + 1) * from.y + m(at + 2) * from.z - to.x
    m(at + 7) += m(at + 4) * from.x + m(at + 5) * from.y + m(at + 6) * from.z - to.y
    m(at + 11) += m(at + 8) * from.x + m(at + 9) * from.y + m(at + 10) * from.z - to.z

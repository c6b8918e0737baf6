package candela.math

import candela.base.loop

/** The linear part of an affine map as a rotation, given by the unit quaternion (x, y, z; w), after
  * a stretch: nine numbers in row order.
  */
private[math] final class PolarDecomposition private (
    val x: Double,
    val y: Double,
    val z: Double,
    val w: Double,
    val stretch: Array[Double]
):
  def dot(b: PolarDecomposition): Double = x * b.x + y * b.y + z * b.z + w * b.w

  /** The same rotation by the opposite quaternion. */
  def reversed: PolarDecomposition = new PolarDecomposition(-x, -y, -z, -w, stretch)

private[math] object PolarDecomposition:

  /** Averages with the inverse transpose until it converges.
    *
    * Source: Higham, "Computing the Polar Decomposition – with Applications", SIAM J. Sci. Stat.
    * Comput. 7(4), 1986.
    */
  def apply(t: Transform): PolarDecomposition =
    val m = nine(i => t.m(4 * (i / 3) + i % 3))
    var r = m
    var change = Double.PositiveInfinity
    var steps = 0
    while change > 1e-14 && steps < MaxSteps do
      val (last, inverse) = (r, transposedInverse(r))
      val next = nine(i => 0.5 * (last(i) + inverse(i)))
      change = 0
      loop(9)(i => change = Math.max(change, Math.abs(next(i) - last(i))))
      r = next
      steps += 1
    val rotation = if determinant(r) < 0 then r.map(-_) else r
    quaternion(rotation, product(transposed(rotation), m))

  private val MaxSteps = 100

  /** A matrix of three rows, without boxing: there may be many thousands of motions. */
  private inline def nine(inline entry: Int => Double): Array[Double] =
    val m = new Array[Double](9)
    loop(9)(i => m(i) = entry(i))
    m

  private def transposed(m: Array[Double]): Array[Double] =
    nine(i => m(3 * (i % 3) + i / 3))

  private def product(a: Array[Double], b: Array[Double]): Array[Double] =
    nine: i =>
      val (row, column) = (3 * (i / 3), i % 3)
      a(row) * b(column) + a(row + 1) * b(3 + column) + a(row + 2) * b(6 + column)

  private def cofactors(m: Array[Double]): Array[Double] =
    nine: i =>
      val r = i / 3
      val c = i % 3
      val r1 = (r + 1) % 3
      val r2 = (r + 2) % 3
      val c1 = (c + 1) % 3
      val c2 = (c + 2) % 3
      m(3 * r1 + c1) * m(3 * r2 + c2) - m(3 * r1 + c2) * m(3 * r2 + c1)

  private def determinant(m: Array[Double]): Double =
    val c = cofactors(m)
    m(0) * c(0) + m(1) * c(1) + m(2) * c(2)

  private def transposedInverse(m: Array[Double]): Array[Double] =
    val (d, c) = (determinant(m), cofactors(m))
    nine(i => c(i) / d)

  /** Divides by the largest of the four components, whose sign becomes positive.
    *
    * Source: Shepperd, "Quaternion from Rotation Matrix", J. Guidance and Control 1, 1978; as in
    * pbrt, the real part is preferred if the trace is positive.
    */
  private def quaternion(r: Array[Double], stretch: Array[Double]): PolarDecomposition =
    val trace = r(0) + r(4) + r(8)
    if trace > 0 then
      val s = Math.sqrt(trace + 1)
      val k = 0.5 / s
      new PolarDecomposition(
        (r(7) - r(5)) * k,
        (r(2) - r(6)) * k,
        (r(3) - r(1)) * k,
        0.5 * s,
        stretch
      )
    else
      val i = (0 until 3).maxBy(d => r(4 * d))
      val j = (i + 1) % 3
      val k = (i + 2) % 3
      val s = Math.sqrt(r(4 * i) - r(4 * j) - r(4 * k) + 1)
      val f = 0.5 / s
      val v = new Array[Double](3)
      v(i) = 0.5 * s
      v(j) = (r(3 * j + i) + r(3 * i + j)) * f
      v(k) = (r(3 * k + i) + r(3 * i + k)) * f
      new PolarDecomposition(v(0), v(1), v(2), (r(3 * k + j) - r(3 * j + k)) * f, stretch)

package candela.shapes

import candela.base.loop
import candela.math.*

/** A cubic Bézier curve with its width at both ends.
  *
  * @param points  twelve numbers: its four control points
  * @param normals normals at both ends of a ribbon; None for other curves
  */
final class BezierCurve(
    val points: Array[Double],
    val width0: Float,
    val width1: Float,
    val normals: Option[(Vec3, Vec3)]
)

/** Converts the curves of scene files to cubic Bézier curves of twelve numbers each, and splits
  * them.
  */
object BezierCurve:

  private def point(p: Array[Float], i: Int): Array[Double] =
    Array(p(3 * i), p(3 * i + 1), p(3 * i + 2))

  private def mix(t: Double, a: Array[Double], b: Array[Double]): Array[Double] =
    Array.tabulate(3)(k => (1 - t) * a(k) + t * b(k))

  /** A Bézier chain: the first `degree` + 1 control points, then `degree` more per curve. */
  def ofBezier(p: Array[Float], degree: Int): Vector[Array[Double]] =
    Vector.tabulate((p.length / 3 - 1) / degree): i =>
      val at = Vector.tabulate(degree + 1)(k => point(p, degree * i + k))
      if degree == 2 then raised(at(0), at(1), at(2)) else at.flatten.toArray

  /** A uniform B-spline: every `degree` + 1 consecutive control points make a curve. By blossoming,
    * with the knots 0, 1, 2, … (Ramshaw, "Blossoms are polar forms", CAGD 6, 1989).
    */
  def ofBSpline(p: Array[Float], degree: Int): Vector[Array[Double]] =
    Vector.tabulate(p.length / 3 - degree): i =>
      val at = Vector.tabulate(degree + 1)(k => point(p, i + k))
      if degree == 2 then raised(mix(0.5, at(0), at(1)), at(1), mix(0.5, at(1), at(2)))
      else
        val b = mix(1.0 / 3, at(1), at(2))
        val c = mix(2.0 / 3, at(1), at(2))
        val a = mix(0.5, mix(2.0 / 3, at(0), at(1)), b)
        val d = mix(0.5, c, mix(1.0 / 3, at(2), at(3)))
        Array.concat(a, b, c, d)

  /** Degree elevation from 2 to 3. */
  private def raised(a: Array[Double], b: Array[Double], c: Array[Double]): Array[Double] =
    Array.concat(a, mix(2.0 / 3, a, b), mix(1.0 / 3, b, c), c)

  /** Control points of the part of a curve from u0 to u1. */
  def part(points: Array[Double], u0: Double, u1: Double): Array[Double] =
    def blossom(a: Double, b: Double, c: Double, k: Int): Double =
      def at(i: Int) = points(3 * i + k)
      def along(t: Double, p: Double, q: Double) = p + t * (q - p)
      val ab = along(a, at(0), at(1))
      val bc = along(a, at(1), at(2))
      val cd = along(a, at(2), at(3))
      along(c, along(b, ab, bc), along(b, bc, cd))
    val out = new Array[Double](12)
    loop(3): k =>
      out(k) = blossom(u0, u0, u0, k)
      out(3 + k) = blossom(u0, u0, u1, k)
      out(6 + k) = blossom(u0, u1, u1, k)
      out(9 + k) = blossom(u1, u1, u1, k)
    out

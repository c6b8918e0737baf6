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

  private def mix(t: Double, a: Array[Double], b: Array[Double]): Array[Double] =
    val mixed = new Array[Double](3)
    loop(3)(k => mixed(k) = (1 - t) * a(k) + t * b(k))
    mixed

  /** Points that follow one another in `p`, from the point `first` on: three numbers each. */
  private def numbers(p: Array[Float], first: Int, points: Int): Array[Double] =
    val doubles = new Array[Double](3 * points)
    loop(3 * points)(k => doubles(k) = p(3 * first + k))
    doubles

  private def point(p: Array[Float], i: Int): Array[Double] = numbers(p, i, 1)

  /** A Bézier chain: the first `degree` + 1 control points, then `degree` more per curve. */
  def ofBezier(p: Array[Float], degree: Int): Array[Array[Double]] =
    Array.tabulate((p.length / 3 - 1) / degree): i =>
      val first = degree * i
      if degree == 2 then raised(point(p, first), point(p, first + 1), point(p, first + 2))
      else numbers(p, first, 4)

  /** A uniform B-spline: every `degree` + 1 consecutive control points make a curve. By blossoming,
    * with the knots 0, 1, 2, … (Ramshaw, "Blossoms are polar forms", CAGD 6, 1989).
    */
  def ofBSpline(p: Array[Float], degree: Int): Array[Array[Double]] =
    Array.tabulate(p.length / 3 - degree): i =>
      val points = Array.tabulate(degree + 1)(k => point(p, i + k))
      if degree == 2 then
        raised(mix(0.5, points(0), points(1)), points(1), mix(0.5, points(1), points(2)))
      else
        val b = mix(1.0 / 3, points(1), points(2))
        val c = mix(2.0 / 3, points(1), points(2))
        val a = mix(0.5, mix(2.0 / 3, points(0), points(1)), b)
        val d = mix(0.5, c, mix(1.0 / 3, points(2), points(3)))
        Array.concat(a, b, c, d)

  /** Degree elevation from 2 to 3. */
  private def raised(a: Array[Double], b: Array[Double], c: Array[Double]): Array[Double] =
    Array.concat(a, mix(2.0 / 3, a, b), mix(1.0 / 3, b, c), c)

  /** Control points of the part of a curve from u0 to u1, in `out`. */
  def subcurve(
      points: Array[Double],
      u0: Double,
      u1: Double,
      out: Array[Double] = new Array[Double](12)
  ): Array[Double] =
    loop(3): k =>
      out(k) = blossom(points, k, u0, u0, u0)
      out(3 + k) = blossom(points, k, u0, u0, u1)
      out(6 + k) = blossom(points, k, u0, u1, u1)
      out(9 + k) = blossom(points, k, u1, u1, u1)
    out

  private def blossom(p: Array[Double], k: Int, a: Double, b: Double, c: Double): Double =
    val ab = along(a, p(k), p(3 + k))
    val bc = along(a, p(3 + k), p(6 + k))
    val cd = along(a, p(6 + k), p(9 + k))
    along(c, along(b, ab, bc), along(b, bc, cd))

  private inline def along(t: Double, p: Double, q: Double) = p + t * (q - p)

package candela.build.shapes

import scala.collection.immutable.ArraySeq

import candela.math.{Vec3, lerp}
import candela.shapes.{BezierCurve, CurveForm}

/** All of a statement of curves but its points: hair has a million strands that differ in these
  * alone.
  *
  * @param numbers of its points
  * @param count   of its curves
  * @param ends    normals of a ribbon, at the ends of its curves
  */
final class Strand(
    spline: Spline,
    numbers: Int,
    count: Int,
    width0: Float,
    width1: Float,
    ends: Option[Vector[Vec3]],
    val form: CurveForm
):
  /** The curves through these points, if they are as many as those of the statement. */
  def through(p: Array[Float]): Option[IndexedSeq[BezierCurve]] =
    Option.when(p.length == numbers && MeshArrays.isFinite(p))(drawn(p))

  /** Likewise; the points have been checked. */
  def drawn(p: Array[Float]): IndexedSeq[BezierCurve] =
    val chain = spline.curves(p)
    ArraySeq.tabulate(count): i =>
      BezierCurve(chain(i), widthAt(i), widthAt(i + 1), ends.map(n => (n(i), n(i + 1))))

  private def widthAt(i: Int) = lerp(i.toFloat / count, width0, width1)

/** How control points make a chain of curves. */
final case class Spline(isBezier: Boolean, degree: Int):

  /** What is wrong with control points. */
  def wrong(p: Array[Float]): Option[String] =
    val points = p.length / 3
    if degree != 2 && degree != 3 then
      Some(s"`degree` of a \"curve\" must be 2 or 3, found $degree")
    else if p.length % 3 != 0 then
      Some(s"`P` must have a multiple of 3 numbers, found ${p.length}")
    else if points < degree + 1 then
      Some(s"`P` of a \"curve\" must have at least ${degree + 1} points, found $points")
    else if isBezier && (points - 1) % degree != 0 then
      Some(s"`P` of a Bézier curve of degree $degree must have ${degree + 1} points plus $degree " +
        s"per further segment, found $points")
    else if !MeshArrays.isFinite(p) then Some("`P` must not contain NaN or infinite numbers")
    else None

  def count(p: Array[Float]): Int =
    if isBezier then (p.length / 3 - 1) / degree else p.length / 3 - degree

  def curves(p: Array[Float]): Array[Array[Double]] =
    if isBezier then BezierCurve.ofBezier(p, degree) else BezierCurve.ofBSpline(p, degree)

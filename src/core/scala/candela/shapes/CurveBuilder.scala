package candela.shapes

import scala.collection.mutable.ArrayBuilder

import candela.base.loop
import candela.math.*

/** Collects curves of one kind for one [[CurveSegments]].
  *
  * @param space   object to world; if empty, curves are transformed to world space when added
  * @param flipped see [[CurveSegments]]
  */
final class CurveBuilder(
    kind: CurveKind,
    space: Option[Transform],
    flipped: Boolean,
    errorWidths: Float
):
  private val points = ArrayBuilder.ofFloat()
  private val params = ArrayBuilder.ofFloat()
  private val widths = ArrayBuilder.ofFloat()
  private val normals = ArrayBuilder.ofFloat()

  /** Adds a curve, split into 2^`splitDepth` segments of equal length in u. `toWorld` is empty if
    * the curve needs no transform. Lengths are scaled by `scale`.
    */
  def add(curve: BezierCurve, splitDepth: Int, toWorld: Option[Transform], scale: Float): Unit =
    val n = 1 << splitDepth
    loop(n): i =>
      val u0 = i.toFloat / n
      val u1 = (i + 1).toFloat / n
      val part = BezierCurve.part(curve.points, u0, u1)
      loop(4)(k => addPoint(part, 3 * k, toWorld))
      params += u0
      params += u1
      widths += lerp(u0, curve.width0, curve.width1) * scale
      widths += lerp(u1, curve.width0, curve.width1) * scale
      for (n0, n1) <- curve.normals; n <- Seq(n0, n1) do
        val unit = toWorld.fold(n)(_.normal(n)).normalized
        normals += unit.x
        normals += unit.y
        normals += unit.z

  private def addPoint(p: Array[Double], i: Int, toWorld: Option[Transform]): Unit =
    toWorld match
      case None => loop(3)(k => points += p(i + k).toFloat)
      case Some(t) =>
        val m = t.m
        loop(3): r =>
          val c = 4 * r
          points += (m(c) * p(i) + m(c + 1) * p(i + 1) + m(c + 2) * p(i + 2) + m(c + 3)).toFloat

  def result: CurveSegments = CurveSegments(
    points.result(), params.result(), widths.result(), normals.result(), kind, space, flipped,
    errorWidths
  )

object CurveBuilder:

  /** Builds the segments of transformed curves: in world space if the transform is a similarity
    * (rotation, translation, uniform scale); else in object space, where widths are measured.
    */
  def segments(
      curves: Seq[BezierCurve],
      kind: CurveKind,
      splitDepth: Int,
      toWorld: Transform,
      reversed: Boolean,
      errorWidths: Float
  ): CurveSegments =
    val scale = toWorld.uniformScale.filter(_ => !toWorld.swapsHandedness)
    val builder = CurveBuilder(
      kind,
      Option.when(scale.isEmpty)(toWorld),
      reversed != toWorld.swapsHandedness,
      errorWidths
    )
    val move = Option.when(scale.isDefined && !toWorld.isIdentity)(toWorld)
    for c <- curves do builder.add(c, splitDepth, move, scale.getOrElse(1.0).toFloat)
    builder.result

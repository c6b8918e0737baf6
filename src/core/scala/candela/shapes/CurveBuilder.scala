package candela.shapes

import candela.base.loop
import candela.math.*

/** Collects curves of one kind for one [[CurveSegments]].
  *
  * @param total   number of segments: scenes have millions of curves of a few each
  * @param space   object to world; if empty, curves are transformed to world space when added
  * @param flipped see [[CurveSegments]]
  */
final class CurveBuilder(
    total: Int,
    kind: CurveKind,
    space: Option[Transform],
    flipped: Boolean,
    errorWidths: Float
):
  private val points = new Array[Float](Math.multiplyExact(12, total))
  private val params, widths = new Array[Float](2 * total)
  private val normals = new Array[Float](if kind == CurveKind.Ribbon then 6 * total else 0)
  private var count = 0

  /** Adds a curve, split into 2^`splitDepth` segments of equal length in u. `toWorld` is empty if
    * the curve needs no transform. Lengths are scaled by `scale`.
    */
  def add(curve: BezierCurve, splitDepth: Int, toWorld: Option[Transform], scale: Float): Unit =
    val n = 1 << splitDepth
    loop(n): i =>
      val u0 = i.toFloat / n
      val u1 = (i + 1).toFloat / n
      val part = BezierCurve.part(curve.points, u0, u1)
      loop(4)(k => putPoint(part, 3 * k, toWorld, 12 * count + 3 * k))
      params(2 * count) = u0
      params(2 * count + 1) = u1
      widths(2 * count) = lerp(u0, curve.width0, curve.width1) * scale
      widths(2 * count + 1) = lerp(u1, curve.width0, curve.width1) * scale
      for (n0, n1) <- curve.normals do
        putNormal(n0, toWorld, 6 * count)
        putNormal(n1, toWorld, 6 * count + 3)
      count += 1

  private def putPoint(p: Array[Double], i: Int, toWorld: Option[Transform], at: Int): Unit =
    toWorld match
      case None => loop(3)(k => points(at + k) = p(i + k).toFloat)
      case Some(t) =>
        val m = t.m
        loop(3): r =>
          val c = 4 * r
          points(at + r) =
            (m(c) * p(i) + m(c + 1) * p(i + 1) + m(c + 2) * p(i + 2) + m(c + 3)).toFloat

  private def putNormal(n: Vec3, toWorld: Option[Transform], at: Int): Unit =
    val unit = toWorld.fold(n)(_.normal(n)).normalized
    normals(at) = unit.x
    normals(at + 1) = unit.y
    normals(at + 2) = unit.z

  def result: CurveSegments =
    require(count == total, s"$count of $total segments")
    CurveSegments(points, params, widths, normals, kind, space, flipped, errorWidths)

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
      Math.multiplyExact(curves.size, 1 << splitDepth),
      kind,
      Option.when(scale.isEmpty)(toWorld),
      reversed != toWorld.swapsHandedness,
      errorWidths
    )
    val move = Option.when(scale.isDefined && !toWorld.isIdentity)(toWorld)
    for c <- curves do builder.add(c, splitDepth, move, scale.getOrElse(1.0).toFloat)
    builder.result

package candela.shapes

import scala.collection.mutable.ArrayBuffer

import candela.base.{Parallel, loop}
import candela.math.*

/** How curves are drawn.
  *
  * @param splitDepth  each is split into 2^`splitDepth` segments of equal length in u
  * @param errorWidths see [[CurveSegments]]
  */
final case class CurveForm(kind: CurveKind, splitDepth: Int, errorWidths: Float)

/** Collects curves of one form and space for one [[CurveSegments]].
  *
  * @param space   object to world; if empty, curves are transformed to world space
  * @param flipped see [[CurveSegments]]
  */
final class CurveBuilder(form: CurveForm, space: Option[Transform], flipped: Boolean):
  import CurveBuilder.Placed

  private val placed = ArrayBuffer.empty[Placed]
  private val split = 1 << form.splitDepth

  /** Number of segments. */
  def count: Int = Math.multiplyExact(placed.length, split)

  /** Whether curves with this transform can be added. */
  def takes(form: CurveForm, toWorld: Transform, reversed: Boolean): Boolean =
    val scale = CurveBuilder.scaleOf(toWorld)
    form == this.form && flipped == (reversed != toWorld.swapsHandedness) &&
    (if scale.isEmpty then space.exists(_ eq toWorld) else space.isEmpty)

  /** Adds curves that are transformed as `takes` was asked. */
  def add(curves: Seq[BezierCurve], toWorld: Transform): Unit =
    if space.isDefined then add(curves, None, 1f)
    else
      val move = Option.unless(toWorld.isIdentity)(toWorld)
      add(curves, move, CurveBuilder.scaleOf(toWorld).getOrElse(1.0).toFloat)

  /** Adds curves with a transform that is not in `space`, if they need one. Lengths are scaled by
    * `scale`.
    */
  def add(curves: Seq[BezierCurve], toWorld: Option[Transform], scale: Float): Unit =
    for c <- curves do placed += Placed(c, toWorld, scale)

  def result(parallel: Parallel = Parallel.Alone): CurveSegments =
    val points = new Array[Float](Math.multiplyExact(12, count))
    val params, widths = new Array[Float](2 * count)
    val normals = new Array[Float](if form.kind == CurveKind.Ribbon then 6 * count else 0)
    parallel.ranges(count): (from, until) =>
      val part = new Array[Double](12)
      loop(from, until): segment =>
        val source = placed(segment / split)
        val curve = source.curve
        val i = segment % split
        val u0 = i.toFloat / split
        val u1 = (i + 1).toFloat / split
        source.putPoints(BezierCurve.part(curve.points, u0, u1, part), points, 12 * segment)
        params(2 * segment) = u0
        params(2 * segment + 1) = u1
        widths(2 * segment) = lerp(u0, curve.width0, curve.width1) * source.scale
        widths(2 * segment + 1) = lerp(u1, curve.width0, curve.width1) * source.scale
        for (n0, n1) <- curve.normals do
          source.putNormal(n0, normals, 6 * segment)
          source.putNormal(n1, normals, 6 * segment + 3)
    CurveSegments(points, params, widths, normals, form.kind, space, flipped, form.errorWidths)

object CurveBuilder:
  /** A builder of transformed curves: in world space if the transform is a similarity (rotation,
    * translation, uniform scale); else in object space, where widths are measured.
    */
  def apply(form: CurveForm, toWorld: Transform, reversed: Boolean): CurveBuilder =
    val space = Option.when(scaleOf(toWorld).isEmpty)(toWorld)
    new CurveBuilder(form, space, reversed != toWorld.swapsHandedness)

  /** The scale of a similarity, which keeps the shape of curves in world space. */
  private def scaleOf(toWorld: Transform): Option[Double] =
    toWorld.uniformScale.filter(_ => !toWorld.swapsHandedness)

  /** The segments of transformed curves. */
  def segments(
      curves: Seq[BezierCurve],
      form: CurveForm,
      toWorld: Transform,
      reversed: Boolean
  ): CurveSegments =
    val builder = CurveBuilder(form, toWorld, reversed)
    builder.add(curves, toWorld)
    builder.result()

  /** A curve with its transform and scale. */
  private final class Placed(val curve: BezierCurve, toWorld: Option[Transform], val scale: Float):

    /** Writes four points. */
    def putPoints(p: Array[Double], to: Array[Float], at: Int): Unit = toWorld match
      case None => loop(12)(k => to(at + k) = p(k).toFloat)
      case Some(t) =>
        val m = t.m
        loop(12): k =>
          val i = k - k % 3
          val c = 4 * (k - i)
          to(at + k) =
            (m(c) * p(i) + m(c + 1) * p(i + 1) + m(c + 2) * p(i + 2) + m(c + 3)).toFloat

    def putNormal(n: Vec3, to: Array[Float], at: Int): Unit =
      val unit = toWorld.fold(n)(_.normal(n)).normalized
      to(at) = unit.x
      to(at + 1) = unit.y
      to(at + 2) = unit.z

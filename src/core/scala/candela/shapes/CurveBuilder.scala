package candela.shapes

import candela.base.loop
import candela.concurrency.Parallel
import scala.collection.mutable.ArrayBuffer

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
  import CurveBuilder.{Place, Placed}

  private val placed = ArrayBuffer.empty[Placed]
  private val split = 1 << form.splitDepth

  /** Where the last curves were: hair has one transform for a million. */
  private var last: Place | Null = null

  /** Number of segments. */
  def count: Int = Math.multiplyExact(placed.length, split)

  /** Whether curves with this transform can be added. */
  def accepts(form: CurveForm, toWorld: Transform, reversed: Boolean): Boolean =
    form == this.form && flipped == (reversed != toWorld.swapsHandedness) &&
      (if placeOf(toWorld).isSimilar then space.isEmpty else space.exists(_ eq toWorld))

  /** Adds curves transformed as `accepts` was asked. */
  def add(curves: Seq[BezierCurve], toWorld: Transform): Unit =
    val placement = if space.isDefined then Place.InSpace else placeOf(toWorld)
    for c <- curves do placed += Placed(c, placement)

  private def placeOf(toWorld: Transform): Place =
    val cached = last
    if cached != null && (cached.toWorld eq toWorld) then cached
    else
      val fresh = Place(toWorld)
      last = fresh
      fresh

  def result(parallel: Parallel = Parallel.Alone): CurveSegments =
    val points = new Array[Float](Math.multiplyExact(12, count))
    val params, widths = new Array[Float](2 * count)
    val normals = new Array[Float](if form.kind == CurveKind.Ribbon then 6 * count else 0)
    parallel.ranges(count): (from, until) =>
      val controlPoints = new Array[Double](12)
      loop(from, until): segment =>
        val source = placed(segment / split)
        val curve = source.curve
        val i = segment % split
        val u0 = i.toFloat / split
        val u1 = (i + 1).toFloat / split
        source.placement.putPoints(
          BezierCurve.subcurve(curve.points, u0, u1, controlPoints),
          points,
          12 * segment
        )
        params(2 * segment) = u0
        params(2 * segment + 1) = u1
        widths(2 * segment) = lerp(u0, curve.width0, curve.width1) * source.placement.scale
        widths(2 * segment + 1) = lerp(u1, curve.width0, curve.width1) * source.placement.scale
        for (n0, n1) <- curve.normals do
          source.placement.putNormal(n0, normals, 6 * segment)
          source.placement.putNormal(n1, normals, 6 * segment + 3)
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

  /** Where curves are: a transform, and the scale of lengths. */
  private final class Place(val toWorld: Transform):
    private val uniformScale = scaleOf(toWorld)
    private val moves = !toWorld.isIdentity
    def isSimilar: Boolean = uniformScale.isDefined
    val scale: Float = uniformScale.getOrElse(1.0).toFloat

    /** Writes four points. */
    def putPoints(p: Array[Double], to: Array[Float], at: Int): Unit =
      if !moves then loop(12)(k => to(at + k) = p(k).toFloat)
      else
        val m = toWorld.m
        loop(12): k =>
          val i = k - k % 3
          val c = 4 * (k - i)
          to(at + k) =
            (m(c) * p(i) + m(c + 1) * p(i + 1) + m(c + 2) * p(i + 2) + m(c + 3)).toFloat

    def putNormal(n: Vec3, to: Array[Float], at: Int): Unit =
      val unit = (if moves then toWorld.normal(n) else n).normalized
      to(at) = unit.x
      to(at + 1) = unit.y
      to(at + 2) = unit.z

  private object Place:
    /** That of curves in their own space. */
    val InSpace: Place = Place(Transform.Identity)

  private final class Placed(val curve: BezierCurve, val placement: Place)

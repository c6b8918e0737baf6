package candela.mitsuba

import candela.base.Decimal
import candela.diagnostics.{Code, SourcePos}
import candela.io.{InputFile, IoReason}
import candela.math.{Position, Transform, Vec3, lerp}
import candela.scenefile.{Param, ParamType}

import java.io.IOException

import scala.collection.mutable.ArrayBuffer

/** Control points of a curve, with the radius at each.
  *
  * @param origin what the points are relative to: not their own origin if they are far from it
  */
final case class CurvePoints(
    points: Vector[Vec3],
    radii: Vector[Float],
    origin: Position = Position.Origin
):
  def placement: Transform = origin.fromOrigin

  /** Has the tube of its spline an open end? */
  def isOpen: Boolean = Seq(0 -> 0.0, points.size - 4 -> 1.0).exists: (segment, t) =>
    Spline.ring(this, segment, t).radius > 0f

  private def moved(toWorld: Transform, to: Position): CurvePoints =
    val map = to.toOrigin * toWorld * placement
    copy(points = points.map(map.point(_)), origin = to)

object CurvePoints:
  /** Sizes of curves from the origin at which they are kept around another. */
  private[mitsuba] val Far = 1024

  /** In world space; Mitsuba's radii are not scaled. */
  def placed(curves: Vector[CurvePoints], toWorld: Transform): Vector[CurvePoints] =
    val map = toWorld * curves.head.placement
    def inWorld(p: Vec3) = map.position(Position(p.x, p.y, p.z))
    val anchor = inWorld(curves.head.points.head)
    val size = curves.iterator.flatMap(_.points).map(p => inWorld(p).distance(anchor)).max
    val isFar = anchor.reach > Far * size
    if !isFar && curves.head.origin.isOrigin then
      curves.map(c => c.copy(points = c.points.map(toWorld.point(_))))
    else curves.map(_.moved(toWorld, if isFar then anchor else Position.Origin))

/** Reads Mitsuba's files of curves: a control point and its radius in each line, empty lines
  * between curves.
  */
object CurveFile:
  /** Coordinates beyond this overflow when they are squared. */
  private val Far = 1e15f

  /** @param minPoints control points of a curve */
  def read(file: InputFile, minPoints: Int, at: SourcePos): Vector[CurvePoints] =
    def fail(reason: String) =
      Values.fail(
        Code.DamagedMesh,
        at,
        s"can't read the curves `${file.path.getFileName}`: $reason"
      )
    val lines =
      try file.lines()
      catch case e: IOException => fail(IoReason(e))
    val builder = Vector.newBuilder[(Vector[Position], Vector[Float])]
    val points = ArrayBuffer.empty[Position]
    val radii = ArrayBuffer.empty[Float]
    def finish(line: Int): Unit =
      if points.nonEmpty && points.size < minPoints then
        fail(s"the curve before line $line has ${points.size} points; it needs $minPoints")
      if points.nonEmpty then builder += points.toVector -> radii.toVector
      points.clear()
      radii.clear()
    for (line, i) <- lines.zipWithIndex do
      val words = line.trim.split("\\s+").filter(_.nonEmpty)
      if words.isEmpty then finish(i + 1)
      else
        val numbers = words.flatMap(Decimal.float).filter(java.lang.Float.isFinite(_))
        if words.length != 4 || numbers.length != 4 || numbers.exists(Math.abs(_) > Far) ||
          numbers(3) < 0f
        then
          val quoted = file.quoted(line.trim.take(60))
          fail(s"line ${i + 1} must have x, y, z and a radius, found $quoted")
        points += Position(words(0).toDouble, words(1).toDouble, words(2).toDouble)
        radii += numbers(3)
    finish(lines.size + 1)
    val curves = builder.result()
    if curves.isEmpty then fail("it has no curve")
    val anchor = curves.head._1.head
    val size = curves.iterator.flatMap(_._1).map(_.distance(anchor)).max
    val origin = if anchor.reach > CurvePoints.Far * size then anchor else Position.Origin
    curves.map: (points, radii) =>
      def relative(p: Position) = Vec3(
        (p.x - origin.x).toFloat,
        (p.y - origin.y).toFloat,
        (p.z - origin.z).toFloat
      )
      CurvePoints(points.map(relative), radii, origin)

/** A curve of pbrt's: a B-spline whose width changes evenly. */
private[mitsuba] final case class Fibre(points: Vector[Vec3], width0: Float, width1: Float):
  def params(at: SourcePos): Seq[Param] = Seq(
    Param.string("type", at, "cylinder"),
    Param.string("basis", at, "bspline"),
    Param.floats(
      ParamType.Point3,
      "P",
      at,
      points.flatMap(p => Seq(p.x, p.y, p.z)).toArray
    ),
    Param.float("width0", at, width0),
    Param.float("width1", at, width1)
  )

private[mitsuba] object Fibres:
  /** The whole curve, if its radius changes evenly, else each segment. */
  def of(c: CurvePoints): Vector[Fibre] =
    val segments = c.points.size - 3
    val widths = Vector.tabulate(segments + 1): i =>
      val (segment, t) = if i < segments then (i, 0.0) else (segments - 1, 1.0)
      2f * Spline.ring(c, segment, t).radius
    val isEven = widths.indices.forall: i =>
      val expected = lerp(i.toFloat / segments, widths.head, widths.last)
      Math.abs(widths(i) - expected) <= 0.01f * widths.max
    if isEven then Vector(Fibre(c.points, widths.head, widths.last))
    else
      Vector.tabulate(segments): i =>
        Fibre(c.points.slice(i, i + 4), widths(i), widths(i + 1))

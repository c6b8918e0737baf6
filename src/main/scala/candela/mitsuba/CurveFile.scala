package candela.mitsuba

import candela.base.SourcePos
import candela.math.{Transform, Vec3, lerp}
import candela.scenefile.{Param, ParamType}

import java.io.IOException
import java.nio.charset.StandardCharsets
import java.nio.file.{Files, Path}

import scala.collection.mutable.ArrayBuffer
import scala.jdk.CollectionConverters.*

/** Control points of a curve, with the radius at each. */
final case class CurvePoints(points: Vector[Vec3], radii: Vector[Float]):
  /** Has the tube of its spline an open end? */
  def isOpen: Boolean = Seq(0 -> 0.0, points.size - 4 -> 1.0).exists: (first, t) =>
    Spline.at(this, first, t).radius > 0f

  /** In world space; Mitsuba's radii are not scaled. */
  def placed(toWorld: Transform): CurvePoints = copy(points = points.map(toWorld.point(_)))

/** Reads Mitsuba's files of curves: a control point and its radius in each line, empty lines
  * between curves.
  */
object CurveFile:
  /** Coordinates beyond this overflow when they are squared. */
  private val Far = 1e15f

  /** @param least control points of a curve */
  def read(path: Path, least: Int, at: SourcePos): Vector[CurvePoints] =
    def fail(why: String) = Values.fail(at, s"can't read the curves `${path.getFileName}`: $why")
    val lines =
      try Files.readAllLines(path, StandardCharsets.ISO_8859_1).asScala
      catch case e: IOException => fail(Option(e.getMessage).getOrElse(e.toString))
    val curves = Vector.newBuilder[CurvePoints]
    val points = ArrayBuffer.empty[Vec3]
    val radii = ArrayBuffer.empty[Float]
    def finish(line: Int): Unit =
      if points.nonEmpty && points.size < least then
        fail(s"the curve before line $line has ${points.size} points; it needs $least")
      if points.nonEmpty then curves += CurvePoints(points.toVector, radii.toVector)
      points.clear()
      radii.clear()
    for (line, i) <- lines.zipWithIndex do
      val words = line.trim.split("\\s+").filter(_.nonEmpty)
      if words.isEmpty then finish(i + 1)
      else
        val numbers = words.flatMap(_.toFloatOption).filter(java.lang.Float.isFinite(_))
        if words.length != 4 || numbers.length != 4 || numbers.exists(Math.abs(_) > Far) ||
          numbers(3) < 0f
        then
          fail(s"line ${i + 1} must have x, y, z and a radius, found `${line.trim.take(60)}`")
        points += Vec3(numbers(0), numbers(1), numbers(2))
        radii += numbers(3)
    finish(lines.size + 1)
    val made = curves.result()
    if made.isEmpty then fail("it has no curve")
    made

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
      val (first, t) = if i < segments then (i, 0.0) else (segments - 1, 1.0)
      2f * Spline.at(c, first, t).radius
    val isEven = widths.indices.forall: i =>
      val expected = lerp(i.toFloat / segments, widths.head, widths.last)
      Math.abs(widths(i) - expected) <= 0.01f * widths.max
    if isEven then Vector(Fibre(c.points, widths.head, widths.last))
    else
      Vector.tabulate(segments): i =>
        Fibre(c.points.slice(i, i + 4), widths(i), widths(i + 1))

package candela.build.shapes

import candela.diagnostics.{Code, Limit}
import candela.build.recipe.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{CurveForm, CurveKind}

object CurveRecipe extends ShapeRecipe("curve", "thin curves such as hair or grass", sinceV3):
  private val points = numbers("P", "point3[]", "control points")
  private val basis = oneOf("basis", "spline basis", Seq("bezier", "bspline"))("bezier")
  private val degree = integer("degree", "spline degree", range = Range(2f, 3f).deferred)(3)
  private val kind = oneOf(
    "type",
    "curve type",
    Seq("flat", "ribbon", "cylinder"),
    forgiven = true,
    instead = "cylinder"
  )("flat")
  private val width = float(
    "width",
    "constant width",
    unit = "scene units",
    range = Range.atLeast(0f).deferred
  )(1f)
  private val width0 = float(
    "width0",
    "width at the start",
    shown = "width",
    range = Range.atLeast(0f).deferred
  )(1f)
  private val width1 = float(
    "width1",
    "width at the end",
    shown = "width",
    range = Range.atLeast(0f).deferred
  )(1f)
  private val normals = numbers("N", "normal[]", "normals of a ribbon, at the ends of its segments")
  private val splitdepth =
    float(
      "splitdepth",
      "number of halvings: each curve is split into 2^splitdepth pieces",
      range = Range(0f, 16f)
    )(3f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val p = points()
    val spline = Spline(basis() == "bezier", degree())
    spline.wrong(p) match
      case Some(message) =>
        site.unusable(Code.ParameterValue, message)
        None
      case None =>
        val count = spline.count(p)
        val ends = ribbonNormals(count)
        if kind() == "ribbon" && ends.isEmpty then None
        else
          for strand <- strand(spline, p.length, count, ends)
          yield ShapeGeometry.Curves(strand, strand.drawn(p))

  /** Normals at the ends of segments. Reports a wrong count and returns None. */
  private def ribbonNormals(curves: Int)(using site: Site): Option[Vector[Vec3]] =
    val n = normals()
    if kind() != "ribbon" then
      if n.nonEmpty then
        site.warn(
          Code.IdleParameter,
          s"`N` of a \"${kind()}\" curve is ignored; only ribbons have normals"
        )
      None
    else if n.length == 3 * (curves + 1) then
      Some(Vector.tabulate(curves + 1)(i => Vec3(n(3 * i), n(3 * i + 1), n(3 * i + 2))))
    else
      val normalCount = n.length / 3
      site.unusable(
        Code.ParameterValue,
        s"`N` of $curves ribbon segments must have ${curves + 1} normals, found $normalCount"
      )
      None

  private def strand(
      spline: Spline,
      numbers: Int,
      curves: Int,
      ends: Option[Vector[Vec3]]
  )(using site: Site): Option[Strand] =
    val (w0, w1) = (width0.given_().getOrElse(width()), width1.given_().getOrElse(width()))
    val depth = splitdepth().toInt
    if !(w0 >= 0f && w1 >= 0f && w0 + w1 > 0f) then
      site.warn(Code.NoSurface, s"a curve of width $w0 to $w1 is invisible; it is ignored")
      None
    else
      val count = curves.toLong << depth
      site.allowance.check(Limit.Triangles, count, Some(site.declaration.pos)):
        s"a curve of $count segments"
      val drawn = kind() match
        case "ribbon" => CurveKind.Ribbon
        case "cylinder" => CurveKind.Cylinder
        case _ => CurveKind.Flat
      // pbrt-v4's ray offset at curves is half of pbrt-v3's
      val errorWidths = if site.dialect == Dialect.V4 then 1f else 2f
      Some(Strand(spline, numbers, curves, w0, w1, ends, CurveForm(drawn, depth, errorWidths)))

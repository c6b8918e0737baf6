package candela.build.shapes

import candela.build.recipe.*
import candela.math.*
import candela.scenefile.Dialect
import candela.shapes.{BezierCurve, CurveBuilder, CurveKind, CurveSegment}

object CurveRecipe extends ShapeRecipe("curve", "a thin strip: a hair, a blade of grass", sinceV3):
  private val points = numbers("P", "point3[]", "control points")
  private val basis = oneOf("basis", "kind of spline", Seq("bezier", "bspline"))("bezier")
  private val degree = integer("degree", "of the spline: 2 or 3")(3)
  private val kind = oneOf("type", "how it is seen", Seq("flat", "ribbon", "cylinder"))("flat")
  private val width = float("width", "all along", unit = "scene units")(1f)
  private val width0 = float("width0", "at the start", shown = "width")(1f)
  private val width1 = float("width1", "at the end", shown = "width")(1f)
  private val normals = numbers("N", "normal[]", "of a ribbon, at all ends of its curves")
  private val splitdepth =
    float("splitdepth", "each curve is cut into 2 to the power of this many segments")(3f)

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (p, d) = (points(), degree())
    val count = p.length / 3
    val isBezier = basis() == "bezier"
    val wrong =
      if d != 2 && d != 3 then Some(s"`degree` of a curve is 2 or 3; found $d")
      else if p.length % 3 != 0 then Some(s"`P` holds ${p.length} numbers, not triples")
      else if count < d + 1 then Some(s"a curve needs ${d + 1} points or more; found $count")
      else if isBezier && (count - 1) % d != 0 then
        Some(s"a Bézier curve of degree $d has ${d + 1} points and $d for each more; found $count")
      else if p.exists(x => !java.lang.Float.isFinite(x)) then
        Some("`P` holds a number that is not finite")
      else None
    wrong match
      case Some(message) =>
        site.error(message)
        None
      case None =>
        val chain = if isBezier then BezierCurve.ofBezier(p, d) else BezierCurve.ofBSpline(p, d)
        val ends = ribbonNormals(chain.size)
        if kind() == "ribbon" && ends.isEmpty then None else curves(chain, ends)

  /** The normals where curves begin and end; None, and reported, if they don't fit. */
  private def ribbonNormals(curves: Int)(using site: Site): Option[Vector[Vec3]] =
    val n = normals()
    if kind() != "ribbon" then
      if n.nonEmpty then site.warn(s"`N` of a ${kind()} curve has no effect: ribbons have normals")
      None
    else if n.length == 3 * (curves + 1) then
      Some(Vector.tabulate(curves + 1)(i => Vec3(n(3 * i), n(3 * i + 1), n(3 * i + 2))))
    else
      site.error(s"a ribbon of $curves curves needs ${curves + 1} normals; found ${n.length / 3}")
      None

  private def curves(chain: Vector[Array[Double]], ends: Option[Vector[Vec3]])(using
      site: Site
  ): Option[ShapeGeometry] =
    val (w0, w1) = (width0.given_().getOrElse(width()), width1.given_().getOrElse(width()))
    def widthAt(i: Int) = lerp(i.toFloat / chain.size, w0, w1)
    val depth = splitdepth().toInt
    if !(w0 >= 0f && w1 >= 0f && w0 + w1 > 0f) then
      site.warn(s"a curve from $w0 to $w1 wide can't be seen: it is left out")
      None
    else if depth < 0 || depth > 16 then
      site.error(s"`splitdepth` lies in 0 to 16; found $depth")
      None
    else
      val all = chain.zipWithIndex.map: (points, i) =>
        BezierCurve(points, widthAt(i), widthAt(i + 1), ends.map(n => (n(i), n(i + 1))))
      val drawn = kind() match
        case "ribbon" => CurveKind.Ribbon
        case "cylinder" => CurveKind.Cylinder
        case _ => CurveKind.Flat
      // pbrt-v4 halved what pbrt-v3 keeps rays away from a curve
      val errorWidths = if site.dialect == Dialect.V4 then 1f else 2f
      Some(
        ShapeGeometry.Solids(
          (toWorld, reversed) =>
            val segments =
              CurveBuilder.segments(all, drawn, depth, toWorld, reversed, errorWidths)
            Vector.tabulate(segments.count)(CurveSegment(segments, _))
          ,
          emits = false
        )
      )

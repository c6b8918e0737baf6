package candela.convert

import candela.color.Rgb
import candela.diagnostics.{Code, Problem, SourcePos}
import candela.sampling.PhaseFunction
import candela.scenefile.{Declaration, Param, ParamType, ShapeDescription}

import scala.collection.mutable

/** What scenes of other formats lose as scenes of pbrt, whatever their materials and lights. */
private[convert] abstract class ForeignLosses:
  protected val problems = mutable.LinkedHashSet.empty[Problem]

  def warnings: Vector[Problem] = problems.toVector

  protected def warn(d: Declaration, message: String): Unit = warn(d.pos, message)
  protected def warn(p: Param, message: String): Unit = warn(p.pos, message)
  protected def warn(at: SourcePos, message: String): Unit =
    problems += Problem.warning(Code.Inexpressible, at, message)

  protected def rgb(name: String, c: Rgb, d: Declaration): Param =
    Param.floats(ParamType.Rgb, name, d.pos, Array(c.r, c.g, c.b))

  protected def withoutParams(d: Declaration, instead: String, names: String*): Declaration =
    for p <- d.params if names.contains(p.name) && instead.nonEmpty do
      warn(p, s"pbrt has no `${p.name}` of \"${d.name}\"; $instead")
    d.copy(params = d.params.filterNot(p => names.contains(p.name)))

  protected def integrator(d: Declaration): Declaration =
    if d.name != "ambientocclusion" then d
    else
      warn(d, "pixels without a surface are black in pbrt, white in Mitsuba")
      if d.param("maxdistance").exists(_.floats.exists(_ < 0f)) then
        withoutParams(d, "surfaces at any distance occlude", "maxdistance")
      else d

  def withoutHeightMaps(shapes: Vector[ShapeDescription]): Vector[ShapeDescription] =
    shapes.filter: s =>
      val isExpressible = s.shape.name != "heightmap"
      if !isExpressible then
        warn(s.shape, "pbrt has no height fields of images; this one is omitted")
      isExpressible

  /** pbrt's media scatter by Henyey and Greenstein: the mean cosine stays. */
  protected def phased(d: Declaration): Declaration =
    def numbers(name: String) = d.param(name).fold(Vector.empty)(_.floats.toVector)
    val summed =
      for
        kinds <- d.param("phases")
        phase <- PhaseFunction.of(kinds.strings, numbers("phaseweights"), numbers("phasevalues"))
      yield (kinds.strings, Param.float("g", d.pos, phase.asymmetry))
    summed.fold(d): (kinds, g) =>
      val named = withoutParams(
        d,
        s"using g = ${Math.round(g.floats(0) * 100) / 100.0} for ${kinds.mkString(" and ")}",
        "phases"
      )
      val plain = withoutParams(named, "", "phaseweights", "phasevalues")
      plain.copy(params = plain.params :+ g)

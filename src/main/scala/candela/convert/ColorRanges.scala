package candela.convert

import candela.diagnostics.{Code, Problem}
import scala.collection.mutable

import candela.scenefile.{Declaration, Param, ParamType}

/** Clamps the colours that pbrt-v4 rejects: negative ones, and reflectances above 1. */
private[convert] object ColorRanges:

  def clamped(from: Converted): Converted =
    val warnings = mutable.LinkedHashSet.empty[Problem]
    val scene = Declarations.map(from.scene): d =>
      d.copy(params = d.params.map(clamped(_, d, warnings.add)))
    Converted(scene, from.warnings ++ warnings)

  private def clamped(p: Param, d: Declaration, warn: Problem => Boolean): Param =
    val upperBound = if isReflectance(p, d) then 1f else Float.PositiveInfinity
    val values = p.floats.map(x => Math.max(0f, Math.min(x, upperBound)))
    if p.paramType != ParamType.Rgb || values.sameElements(p.floats) then p
    else
      val range = if upperBound == 1f then "in [0, 1]" else "not negative"
      val message = s"a colour is ${written(p.floats)}; pbrt-v4 takes only colours $range: clamping"
      val _ = warn(Problem.warning(Code.ShiftedColors, p.pos, message))
      p.withFloats(values)

  private def written(values: Array[Float]) = values.map(NumberText.of).mkString(" ")

  private def isReflectance(p: Param, d: Declaration): Boolean =
    (d.category == "Material" || d.category == "Texture") && !Values.Unbounded(p.name)

package candela.convert

import candela.diagnostics.Code
import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.scenefile.{Param, ParamType}

/** Scale of lights. v3 uses colours as given; v4 first normalises all spectra except RGB to
  * luminance 1.
  */
object Emission:

  /** Converts v3's colour and coloured `scale` to v4's colour and scalar `scale`. */
  def toV4(color: String): Step =
    Step(s"`$color`, `scale`", s"`$color`, scalar `scale`"): s =>
      val base = s.take(color)
      val factor = s.take("scale").flatMap(s.colorOf).getOrElse(Rgb.White)
      if !Values.isGray(factor) then
        val c = base.fold(Rgb.White)(p => rgb(p, s))
        s.addRgb(color, positive(c * factor))(using base.fold(s.declaration.pos)(_.pos))
      else
        val intensity = base.fold(1f)(p => add(p, color, s))
        if intensity * factor.r != 1f then s.addFloat("scale", intensity * factor.r)

  /** Converts v4's colour and scale to v3's, including `power` and similar parameters.
    *
    * @param absolute the factor equivalent to such a parameter, given its value
    */
  def toV3(color: String, power: String, absolute: (Float, Statement) => Option[Float]): Step =
    Step(s"`$color`, `scale`, `$power`", s"`$color`, `scale`"): s =>
      val base = s.take(color)
      var factor = s.takeNumber("scale", 1f)
      for p <- s.take(power); value <- s.numberOf(p) if value > 0f do
        absolute(value, s) match
          case Some(f) => factor *= f
          case None => s.warn(
              Code.Inexpressible,
              p.pos,
              s"`$power` has no computable equivalent in v3; ignored"
            )
      for p <- base do
        p.paramType match
          case ParamType.Rgb => s.addRaw(p)
          case ParamType.Blackbody =>
            val y = luminance(Spectrum.blackbody(p.floats(0)))
            val floats = Array(p.floats(0), 1f / y)
            s.addRaw(Param(ParamType.Blackbody, color, p.pos, p.valuesAt, floats = floats))
          case _ =>
            for x <- s.run.values.spectrum(p, s.declaration) do
              s.addRgb(color, positive(Colorimetry.unitLuminance(x)))(using p.pos)
      if factor != 1f then s.addRgb("scale", Rgb.gray(factor))

  private def rgb(p: Param, s: Statement): Rgb = s.colorOf(p).getOrElse(Rgb.White)

  /** Adds the colour in v4's form; returns the factor removed from it. */
  private def add(p: Param, name: String, s: Statement): Float = p.paramType match
    case ParamType.Blackbody =>
      s.addRaw(Param(ParamType.Blackbody, name, p.pos, p.valuesAt, floats = p.floats.take(1)))
      (if p.floats.length > 1 then p.floats(1) else 1f) * luminance(Spectrum.blackbody(p.floats(0)))
    case ParamType.Spectrum =>
      // In v3's RGB, because v3 multiplies colours, not spectra.
      s.addRgb(name, positive(rgb(p, s)))(using p.pos)
      1f
    case ParamType.Rgb =>
      s.addRaw(Param(
        ParamType.Rgb,
        name,
        p.pos,
        p.valuesAt,
        floats = p.floats.map(Math.max(_, 0f))
      ))
      1f
    case _ =>
      s.addRgb(name, positive(rgb(p, s)))(using p.pos)
      1f

  private def luminance(x: Spectrum): Float = Colorimetry.rgb(x, White.EqualEnergy).luminance

  /** Clamps negative components, of saturated spectra outside the sRGB gamut. */
  private def positive(c: Rgb): Rgb = c.map(Math.max(_, 0f))

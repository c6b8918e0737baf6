package candela.convert

import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.scenefile.{Param, ParamType}

/** How strong lights are. In v3 the colour counts as it is; v4 brings every spectrum that is no RGB
  * colour to luminance 1 first.
  */
object Emission:

  /** v3's colour and coloured `scale` into v4's colour and plain `scale`. */
  def toV4(color: String): Step =
    Step(s"`$color`, `scale`", s"`$color`, and `scale` without colour"): s =>
      val base = s.take(color)
      val factor = s.take("scale").flatMap(s.colorOf).getOrElse(Rgb.White)
      if !Values.isGray(factor) then
        val c = base.fold(Rgb.White)(p => rgb(p, s))
        s.addRgb(color, positive(c * factor))(using base.fold(s.declaration.at)(_.at))
      else
        val own = base.fold(1f)(p => add(p, color, s))
        if own * factor.r != 1f then s.addFloat("scale", own * factor.r)

  /** v4's into v3's, with what `power` and the like make of it.
    *
    * @param absolute the factor that such a parameter stands for, given its value
    */
  def toV3(color: String, power: String, absolute: (Float, Statement) => Option[Float]): Step =
    Step(s"`$color`, `scale`, `$power`", s"`$color`, `scale`"): s =>
      val base = s.take(color)
      var factor = s.takeNumber("scale", 1f)
      for p <- s.take(power); value <- s.numberOf(p) if value > 0f do
        absolute(value, s) match
          case Some(f) => factor *= f
          case None => s.warn(p.at, s"`$power` can't be said in v3, nor calculated here: left out")
      for p <- base do
        p.paramType match
          case ParamType.Rgb => s.addRaw(p)
          case ParamType.Blackbody =>
            val y = luminance(Spectrum.blackbody(p.floats(0)))
            val floats = Array(p.floats(0), 1f / y)
            s.addRaw(Param(ParamType.Blackbody, color, p.at, p.valuesAt, floats = floats))
          case _ =>
            for x <- s.run.values.spectrum(p, s.declaration) do
              s.addRgb(color, positive(Colorimetry.unitLuminance(x(_))))(using p.at)
      if factor != 1f then s.addRgb("scale", Rgb.gray(factor))

  private def rgb(p: Param, s: Statement): Rgb = s.colorOf(p).getOrElse(Rgb.White)

  /** Adds the colour as v4 writes it; the factor that it lost. */
  private def add(p: Param, name: String, s: Statement): Float = p.paramType match
    case ParamType.Blackbody =>
      s.addRaw(Param(ParamType.Blackbody, name, p.at, p.valuesAt, floats = p.floats.take(1)))
      (if p.floats.length > 1 then p.floats(1) else 1f) * luminance(Spectrum.blackbody(p.floats(0)))
    case ParamType.Spectrum =>
      // As v3 sees it, for it multiplies colours and not spectra
      s.addRgb(name, positive(rgb(p, s)))(using p.at)
      1f
    case ParamType.Rgb =>
      s.addRaw(Param(ParamType.Rgb, name, p.at, p.valuesAt, floats = p.floats.map(Math.max(_, 0f))))
      1f
    case _ =>
      s.addRgb(name, positive(rgb(p, s)))(using p.at)
      1f

  private def luminance(x: Spectrum): Float = Colorimetry.rgb(x(_), White.EqualEnergy).luminance

  /** A saturated spectrum is outside of what sRGB can show. */
  private def positive(c: Rgb): Rgb = c.map(Math.max(_, 0f))

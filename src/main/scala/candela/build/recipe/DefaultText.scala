package candela.build.recipe

import candela.color.Rgb
import candela.math.Vec3

/** Defaults as a scene file would write them. */
private[build] object DefaultText:

  /** The shortest decimals that read back as the same number; whole numbers have none. */
  def number(x: Float): String =
    if x == Float.PositiveInfinity then "infinite"
    else if x == Float.NegativeInfinity then "-infinite"
    else
      val decimal = java.math.BigDecimal(x.toString).stripTrailingZeros
      if Math.abs(x) < 1e6f then decimal.toPlainString else decimal.toString.replace("E+", "e")

  def quoted(s: String): String = "\"" + s + "\""

  def triple(v: Vec3): String = s"${number(v.x)} ${number(v.y)} ${number(v.z)}"

  /** One number for a grey. */
  def color(c: Rgb): String =
    if c.r == c.g && c.g == c.b then number(c.r)
    else s"${number(c.r)} ${number(c.g)} ${number(c.b)}"

  def spectrum(v: SpectralValue): String = v match
    case SpectralValue.Color(c) => color(c)
    case SpectralValue.Wavelengths(_) => "a spectrum"

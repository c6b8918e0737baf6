package candela.color

/** Colours outside the gamut of sRGB, for displays. */
object Gamut:

  /** A colour without negative components: if necessary mixed with the grey of its luminance, which
    * keeps luminance and dominant wavelength. Clamping each component would brighten the colour and
    * change its hue.
    *
    * Source: Hall, "Illumination and Color in Computer Generated Imagery", Springer 1989, ch. 5.
    */
  def desaturate(c: Rgb): Rgb =
    val minimum = Math.min(c.r, Math.min(c.g, c.b))
    val y = c.luminance
    if !(minimum < 0f) then c
    else if y == Float.PositiveInfinity then c.map(Math.max(_, 0f))
    else
      if !(y > 0f) then Rgb.Black
      else
        val share = y / (y - minimum)
        c.map(v => Math.max(0f, y + (v - y) * share))

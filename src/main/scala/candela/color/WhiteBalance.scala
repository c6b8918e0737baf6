package candela.color

/** Makes light of one white look as that of sRGB's white does.
  *
  * Source: Lam, "Metamerism and Colour Constancy", PhD thesis, University of Bradford 1985, whose
  * responses of the eye are scaled as von Kries proposed; CIE 15:2004, §3.1, for daylight.
  */
object WhiteBalance:

  /** Of D65 and sRGB, as x and y of CIE 1931. */
  private val Target = (0.3127, 0.3290)

  private val ToResponse = Matrix3(
    Vector(
      0.8951, 0.2664, -0.1614, //
      -0.7502, 1.7135, 0.0367, //
      0.0389, -0.0685, 1.0296
    )
  )

  /** The map of linear sRGB, nine numbers row by row, that makes daylight of the colour temperature
    * `kelvin` white.
    */
  def ofDaylight(kelvin: Float): Array[Float] =
    val from = response(chromaticity(Daylight.correlated(kelvin)))
    val to = response(Target)
    val scale = Matrix3.tabulate((r, c) => if r == c then to(r) / from(r) else 0.0)
    val ofXyz = ToResponse.inverse * scale * ToResponse
    (Colorimetry.rgbOfXyz * ofXyz * Colorimetry.xyzOfRgb).toFloats

  /** Of daylight; below 4000 K, where there is none, of a black body. */
  private[color] def chromaticity(kelvin: Double): (Double, Double) =
    if kelvin < 4000 then
      val body = Spectrum.blackbody(kelvin.toFloat)
      val c = Colorimetry.rgb(body(_), Colorimetry.White.EqualEnergy)
      val v = Colorimetry.xyzOfRgb * Vector(c.r, c.g, c.b).map(_.toDouble)
      (v(0) / v.sum, v(1) / v.sum)
    else
      val t = 1e3 / kelvin
      val x =
        if kelvin <= 7000 then -4.6070 * t * t * t + 2.9678 * t * t + 0.09911 * t + 0.244063
        else -2.0064 * t * t * t + 1.9018 * t * t + 0.24748 * t + 0.237040
      (x, -3 * x * x + 2.870 * x - 0.275)

  private def response(white: (Double, Double)): Vector[Double] =
    val (x, y) = white
    ToResponse * Vector(x / y, 1, (1 - x - y) / y)

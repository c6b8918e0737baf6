package candela.color

/** Makes light of one white look as that of sRGB's white does.
  *
  * Source: Lam, "Metamerism and Colour Constancy", PhD thesis, University of Bradford 1985, whose
  * responses of the eye are scaled as von Kries proposed; CIE 15:2004, §3.1, for daylight.
  */
object WhiteBalance:

  /** Of D65 and sRGB, as x and y of CIE 1931. */
  private val Target = (0.3127, 0.3290)

  private val ToResponse = Vector(
    Vector(0.8951, 0.2664, -0.1614),
    Vector(-0.7502, 1.7135, 0.0367),
    Vector(0.0389, -0.0685, 1.0296)
  )

  /** The map of linear sRGB, nine numbers row by row, that makes daylight of the colour temperature
    * `kelvin` white.
    */
  def ofDaylight(kelvin: Float): Array[Float] =
    // As named daylights are, by Planck's constant of before 1968
    val white = chromaticity(kelvin * 1.4388 / 1.4380)
    val from = response(white)
    val to = response(Target)
    columns: rgb =>
      val seen = times(ToResponse, xyz(rgb))
      val (x, y, z) = solved(Vector.tabulate(3)(i => seen(i) * to(i) / from(i)))
      val c = Colorimetry.fromXyz(x, y, z)
      Vector(c.r, c.g, c.b)

  /** Of daylight; below 4000 K, where there is none, of a black body. */
  private[color] def chromaticity(kelvin: Double): (Double, Double) =
    if kelvin < 4000 then
      val body = Spectrum.blackbody(kelvin.toFloat)
      val c = Colorimetry.rgb(body(_), Colorimetry.White.EqualEnergy)
      val v = xyz(Vector(c.r, c.g, c.b).map(_.toDouble))
      (v(0) / v.sum, v(1) / v.sum)
    else
      val t = 1e3 / kelvin
      val x =
        if kelvin <= 7000 then -4.6070 * t * t * t + 2.9678 * t * t + 0.09911 * t + 0.244063
        else -2.0064 * t * t * t + 1.9018 * t * t + 0.24748 * t + 0.237040
      (x, -3 * x * x + 2.870 * x - 0.275)

  private def response(white: (Double, Double)): Vector[Double] =
    val (x, y) = white
    times(ToResponse, Vector(x / y, 1, (1 - x - y) / y))

  private def xyz(rgb: Vector[Double]): Vector[Double] =
    Vector.tabulate(3)(r => (0 until 3).map(c => Colorimetry.XyzOfRgb(3 * r + c) * rgb(c)).sum)

  private def times(m: Vector[Vector[Double]], v: Vector[Double]): Vector[Double] =
    m.map(row => row.lazyZip(v).map(_ * _).sum)

  /** X, Y and Z that have this response, by Cramer's rule. */
  private def solved(wanted: Vector[Double]): (Double, Double, Double) =
    def determinant(m: Vector[Vector[Double]]) =
      def minor(a: Int, b: Int) = m(1)(a) * m(2)(b) - m(1)(b) * m(2)(a)
      m(0)(0) * minor(1, 2) - m(0)(1) * minor(0, 2) + m(0)(2) * minor(0, 1)
    def part(c: Int) =
      val replaced = ToResponse.lazyZip(wanted).map((row, w) => row.updated(c, w))
      determinant(replaced) / determinant(ToResponse)
    (part(0), part(1), part(2))

  private def columns(map: Vector[Double] => Vector[Float]): Array[Float] =
    val images = Vector.tabulate(3)(c => map(Vector.tabulate(3)(i => if i == c then 1.0 else 0.0)))
    Array.tabulate(9)(i => images(i % 3)(i / 3))

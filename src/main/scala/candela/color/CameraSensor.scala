package candela.color

/** The sensor of a camera: three kinds of cells, by what they make of each wavelength.
  *
  * @param curves of the cells for red, green and blue; 0 beyond their ends
  *
  * Source of the measurements: Langlands and Fascione, "PhysLight: An End-to-End Pipeline for
  * Scene-Referred Lighting", SIGGRAPH 2020 Talks; PBRT 4th ed., §5.4.2.
  */
final class CameraSensor(curves: Vector[Spectrum]):

  /** What the cells make of a colour, in units in which the observer's y makes luminance of it. */
  lazy val response: ColorResponse =
    val grid = Array.tabulate(95)(i => 360f + 5f * i)
    val scale = 5 / Colorimetry.luminanceOfD65
    ColorResponse(curves.map: curve =>
      Detector(grid, grid.map(nm => (scale * curve(nm) * Colorimetry.D65(nm)).toFloat)))

  /** From what the cells make of light to linear sRGB, for photographs taken in daylight of this
    * colour temperature: nine numbers row by row, by which a chart's colours err least.
    */
  def toSrgb(kelvin: Float): Array[Float] = (Colorimetry.rgbOfXyz * toXyz(kelvin)).toFloats

  private def toXyz(kelvin: Float): Matrix3 =
    val light = Daylight.spectrum(kelvin)
    val observers = Colorimetry.observers
    val whiteY = CameraSensor.integral(nm => light(nm) * observers(1)(nm))
    val whiteG = CameraSensor.integral(nm => light(nm) * curves(1)(nm))
    val seen = CameraSensor.chart.map(projected(_, light, curves))
    val wanted = CameraSensor.chart.map: patch =>
      projected(patch, Colorimetry.D65, observers).map(_ * whiteY / whiteG)
    // Linear least squares, by the normal equations
    def products(a: Vector[Vector[Double]], b: Vector[Vector[Double]]) =
      Matrix3.tabulate((r, c) => a.lazyZip(b).map((x, y) => x(r) * y(c)).sum)
    (products(seen, seen).inverse * products(seen, wanted)).transposed

  /** What three responses make of light that was reflected, over what the second makes of all. */
  private def projected(reflectance: Spectrum, light: Spectrum, responses: Vector[Spectrum]) =
    val all = CameraSensor.integral(nm => light(nm) * responses(1)(nm))
    responses.map(r => CameraSensor.integral(nm => reflectance(nm) * light(nm) * r(nm)) / all)

object CameraSensor:
  /** As pbrt-v4 calls them. */
  val names: Vector[String] = Vector(
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d", "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii", "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds", "canon_eos_m",
    "hasselblad_l1d_20c", "nikon_d810", "nikon_d850", "sony_ilce_6400", "sony_ilce_7m3",
    "sony_ilce_7rm3", "sony_ilce_9"
  )

  def named(name: String): Option[CameraSensor] =
    Option.when(names.contains(name))(CameraSensor(spectra(s"camera-$name")))

  /** Eight spectra in place of the 24 that pbrt-v4 fits to, those of a ColorChecker: their products
    * for any two wavelengths sum to the same, to four digits, and the fit depends on nothing else.
    * The matrices of all sensors agree to 2e-4 of their largest number.
    */
  private lazy val chart: Vector[Spectrum] = spectra("chart")

  private def spectra(file: String): Vector[Spectrum] =
    val rows = Colorimetry.table(file)
    Vector.tabulate(rows.head.length - 1): c =>
      Spectrum(rows.map(_(0)), rows.map(_(c + 1)), Spectrum.Outside.Zero)

  /** Over the wavelengths that pbrt-v4 has, in nm. */
  private def integral(f: Float => Float): Double =
    (360 to 830).map(nm => f(nm.toFloat).toDouble).sum

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

package candela.color

/** A camera sensor: spectral responses of its three channels.
  *
  * @param curves responses for red, green and blue; constant outside their range, as in pbrt-v4
  *
  * Source of the measurements: Langlands and Fascione, "PhysLight: An End-to-End Pipeline for
  * Scene-Referred Lighting", SIGGRAPH 2020 Talks; PBRT 4th ed., §5.4.2.
  */
final class CameraSensor(curves: Vector[Spectrum]):

  /** Responses of the channels to light of a wavelength in nm. */
  def responses(nm: Float): Array[Double] = curves.map(_(nm).toDouble).toArray

  /** Response of the channels to a colour, in units in which the observer's y yields luminance. */
  lazy val response: ColorResponse =
    val grid = Array.tabulate(95)(i => 360f + 5f * i)
    val scale = 5 / Colorimetry.luminanceOfD65
    ColorResponse(curves.map: curve =>
      Detector(grid, grid.map(nm => (scale * curve(nm) * Colorimetry.D65(nm)).toFloat)))

  /** Matrix from sensor response to a colour space, for photographs taken in daylight of this
    * colour temperature: nine numbers in row order, with the least error over a colour chart under
    * the space's illuminant.
    */
  def toRgb(kelvin: Float, space: ColorSpace = ColorSpace.Srgb): Array[Float] =
    (space.rgbOfXyz * toXyz(kelvin, space.illuminant)).toFloats

  private def toXyz(kelvin: Float, illuminant: Spectrum): Matrix3 =
    val light = Daylight.spectrum(kelvin)
    val observers = Colorimetry.observers
    val whiteY = CameraSensor.integral(nm => light(nm) * observers(1)(nm))
    val whiteG = CameraSensor.integral(nm => light(nm) * curves(1)(nm))
    val measured = CameraSensor.chart.map(projected(_, light, curves))
    val wanted = CameraSensor.chart.map: patch =>
      projected(patch, illuminant, observers).map(_ * whiteY / whiteG)
    // Linear least squares, by the normal equations
    def products(a: Vector[Vector[Double]], b: Vector[Vector[Double]]) =
      Matrix3.tabulate((r, c) => a.lazyZip(b).map((x, y) => x(r) * y(c)).sum)
    (products(measured, measured).inverse * products(measured, wanted)).transposed

  /** Three responses to reflected light, over the second response to the unfiltered light. */
  private def projected(reflectance: Spectrum, light: Spectrum, responses: Vector[Spectrum]) =
    val normalization = CameraSensor.integral(nm => light(nm) * responses(1)(nm))
    responses.map(r =>
      CameraSensor.integral(nm => reflectance(nm) * light(nm) * r(nm)) / normalization
    )

object CameraSensor:
  /** Names as in pbrt-v4. */
  val names: Vector[String] = Vector(
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d", "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii", "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds", "canon_eos_m",
    "hasselblad_l1d_20c", "nikon_d810", "nikon_d850", "sony_ilce_6400", "sony_ilce_7m3",
    "sony_ilce_7rm3", "sony_ilce_9"
  )

  private[color] def file(name: String): String = s"camera-$name"

  def named(name: String): Option[CameraSensor] =
    Option.when(names.contains(name))(CameraSensor(spectra(file(name))))

  /** Eight spectra in place of the 24 of a ColorChecker, to which pbrt-v4 fits: their products for
    * any two wavelengths have the same sum, to four digits, and the fit depends on nothing else.
    * The matrices of all sensors agree to 2e-4 of their largest number.
    */
  private lazy val chart: Vector[Spectrum] = spectra("chart")

  private def spectra(file: String): Vector[Spectrum] =
    val rows = Colorimetry.table(file)
    Vector.tabulate(rows.head.length - 1): c =>
      Spectrum(rows.map(_(0)), rows.map(_(c + 1)), Spectrum.Outside.Clamped)

  /** Integral over pbrt-v4's range of wavelengths, in nm. */
  private def integral(f: Float => Float): Double =
    (360 to 830).map(nm => f(nm.toFloat).toDouble).sum

/** White balance by chromatic adaptation.
  *
  * Source: Lam, "Metamerism and Colour Constancy", PhD thesis, University of Bradford 1985, whose
  * cone responses are scaled as von Kries proposed; CIE 15:2004, §3.1, for daylight.
  */
object WhiteBalance:

  private val ToResponse = Matrix3(
    Vector(
      0.8951, 0.2664, -0.1614, //
      -0.7502, 1.7135, 0.0367, //
      0.0389, -0.0685, 1.0296
    )
  )

  /** Matrix from linear sRGB to a colour space that maps daylight of the colour temperature
    * `kelvin` to its white: nine numbers in row order.
    */
  def ofDaylight(kelvin: Float, space: ColorSpace = ColorSpace.Srgb): Array[Float] =
    val sourceWhite = chromaticity(Daylight.correlated(kelvin))
    val ofXyz = adaptation(sourceWhite, space.primaries.white)
    (space.rgbOfXyz * ofXyz * Colorimetry.xyzOfRgb).toFloats

  /** Matrix on X, Y and Z that maps one white, by chromaticity, to another. */
  private[color] def adaptation(from: (Double, Double), to: (Double, Double)): Matrix3 =
    val (source, wanted) = (response(from), response(to))
    val scale = Matrix3.tabulate((r, c) => if r == c then wanted(r) / source(r) else 0.0)
    ToResponse.inverse * scale * ToResponse

  /** Chromaticity of daylight; below 4000 K, where daylight is undefined, of a black body. */
  private[color] def chromaticity(kelvin: Double): (Double, Double) =
    if kelvin < 4000 then
      val body = Spectrum.blackbody(kelvin.toFloat)
      val c = Colorimetry.rgb(body, Colorimetry.White.EqualEnergy)
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

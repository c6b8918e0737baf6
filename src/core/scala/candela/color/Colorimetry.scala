package candela.color

import scala.io.{Codec, Source}

/** Converts spectra to linear sRGB with the CIE 1931 observer. */
object Colorimetry:

  /** Illuminant under which a spectrum is converted. */
  enum White:
    /** Equal energy, as in pbrt-v2 and v3. A constant 1 becomes a slightly reddish colour. */
    case EqualEnergy

    /** The white of sRGB: a constant 1 becomes (1, 1, 1). pbrt-v4's convention for reflectances.
      */
    case D65

  /** Wavelengths at which integrals are sampled: 360–830 nm in steps of 5. */
  private lazy val observer: Array[Array[Float]] = table("cie1931")
  lazy val D65: Spectrum = NamedSpectra("stdillum-D65").get

  /** The observer's colour matching functions x, y and z. */
  private[color] lazy val observers: Vector[Spectrum] =
    Vector.tabulate(3)(i => Spectrum(observer.map(_(0)), observer.map(_(i + 1))))

  /** Spectral radiance at a wavelength of light with the spectrum of D65 and luminance 1, in units
    * in which a constant spectrum of 1 has luminance 1: as in pbrt-v4.
    */
  def radianceOfD65(nm: Float): Float = (D65(nm) * EvenLuminance / luminanceOfD65).toFloat

  /** Integral of the observer's y over the wavelength in nm (CIE 018:2019). */
  private val EvenLuminance = 106.856895

  /** Luminance of D65, over wavelength in nm: pbrt-v4's normalisation of light spectra. */
  private[color] lazy val luminanceOfD65: Double =
    observer.map(row => 5.0 * row(2) * D65(row(0))).sum

  /** The observer between its samples. */
  private lazy val observerByNm: Array[Array[Float]] =
    Array.tabulate(471): i =>
      val nm = 360f + i
      Array(nm, observers(0)(nm), observers(1)(nm), observers(2)(nm))

  /** Colour of a spectrum given by its values, in steps of 1 nm if it may vary within 5. */
  def rgb(spectrum: Spectrum, white: White): Rgb =
    rgb(spectrum(_), white, if spectrum.isCoarse then observer else observerByNm)

  /** Colour of a smooth reflectance (or index of refraction, …) that depends on wavelength. */
  def rgb(spectrum: Float => Float, white: White): Rgb = rgb(spectrum, white, observer)

  /** D65 at the observer's wavelengths. */
  private lazy val daylight: Array[Float] = observer.map(row => D65(row(0)))
  private lazy val daylightByNm: Array[Float] = observerByNm.map(row => D65(row(0)))

  private def rgb(spectrum: Float => Float, white: White, observer: Array[Array[Float]]): Rgb =
    val lights =
      if white != White.D65 then null
      else if observer eq this.observer then daylight
      else daylightByNm
    var x, y, z, sum = 0.0
    var i = 0
    while i < observer.length do
      val row = observer(i)
      val light = if lights != null then lights(i) else 1f
      val s = spectrum(row(0)) * light
      x += s * row(1)
      y += s * row(2)
      z += s * row(3)
      sum += light * row(2)
      i += 1
    fromXyz(x / sum, y / sum, z / sum)

  /** The spectrum, evaluated once at each wavelength of smooth colours: for those that many are
    * made of.
    */
  def memoized(spectrum: Float => Float): Float => Float =
    lazy val values = wavelengths.map(spectrum)
    nm =>
      val i = ((nm - wavelengths(0)) * 0.2f).toInt
      if i >= 0 && i < wavelengths.length && wavelengths(i) == nm then values(i) else spectrum(nm)

  /** Wavelengths in nm, 5 apart, and the contribution of each to white under D65. */
  lazy val responses: Array[(Float, Rgb)] =
    for Array(nm, x, y, z) <- observer yield
      val light = D65(nm).toDouble
      (nm, fromXyz(light * x, light * y, light * z))

  /** The wavelengths of [[responses]]. */
  private[color] lazy val wavelengths: Array[Float] = responses.map(_._1)

  /** Shares of [[responses]] in the channels of white: red, green, blue for each wavelength. */
  private[color] lazy val shares: Array[Double] =
    val raw = responses.map((_, c) => Array(c.r.toDouble, c.g, c.b))
    val sums = Array.tabulate(3)(i => raw.map(_(i)).sum)
    raw.flatMap(row => Array.tabulate(3)(i => row(i) / sums(i)))

  /** Colour of emitted light, scaled to luminance (CIE Y) 1: pbrt-v4's convention for emission. */
  def unitLuminance(spectrum: Spectrum): Rgb =
    val c = rgb(spectrum, White.EqualEnergy)
    c * (1f / c.luminance)

  /** X, Y and Z of linear sRGB: the primaries of IEC 61966-2-1, in row order. */
  val XyzOfRgb: Array[Float] = Array(
    0.412453f, 0.357580f, 0.180423f, //
    0.212671f, 0.715160f, 0.072169f, //
    0.019334f, 0.119193f, 0.950227f
  )

  private[color] val xyzOfRgb: Matrix3 = Matrix3(XyzOfRgb.map(_.toDouble).toVector)

  /** IEC 61966-2-1, the inverse of its matrix of primaries. */
  private[color] val rgbOfXyz: Matrix3 = Matrix3(
    Vector(
      3.240479, -1.537150, -0.498535, //
      -0.969256, 1.875991, 0.041556, //
      0.055648, -0.204043, 1.057311
    )
  )

  def fromXyz(x: Double, y: Double, z: Double): Rgb =
    def channel(r: Int): Float =
      val m = rgbOfXyz
      (m(r, 0) * x + m(r, 1) * y + m(r, 2) * z).toFloat
    Rgb(channel(0), channel(1), channel(2))

  /** Rows of numbers; lines that begin with # are comments. */
  private[color] def table(name: String): Array[Array[Float]] =
    val stream = getClass.getResourceAsStream(s"/candela/spectra/$name.txt")
    val source = Source.fromInputStream(stream)(using Codec.UTF8)
    try
      source.getLines().filterNot(_.startsWith("#")).map(_.trim.split(' ').map(_.toFloat)).toArray
    finally source.close()

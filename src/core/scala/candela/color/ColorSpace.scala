package candela.color

/** Chromaticities x and y of the primaries and of white (CIE 1931). */
final case class Primaries(
    red: (Double, Double),
    green: (Double, Double),
    blue: (Double, Double),
    white: (Double, Double)
):
  /** X, Y and Z of the components, given those of white. Not invertible if the primaries are
    * collinear.
    *
    * Source: SMPTE RP 177-1993, "Derivation of Basic Television Color Equations".
    */
  private[color] def toXyz(whiteXyz: Vector[Double]): Matrix3 =
    val columns = Vector(red, green, blue).map(Primaries.xyz)
    val shape = Matrix3.tabulate((r, c) => columns(c)(r))
    val scale = shape.inverse * whiteXyz
    Matrix3.tabulate((r, c) => shape(r, c) * scale(c))

  /** X, Y and Z of white. */
  private[color] def whiteXyz: Vector[Double] = Primaries.xyz(white).map(_ / white._2)

  /** As stored in OpenEXR files: x and y of red, green, blue and white. */
  def toFloats: Array[Float] =
    Array(red, green, blue, white).flatMap((x, y) => Array(x.toFloat, y.toFloat))

  /** Within a thousandth, as in pbrt-v4. */
  def isNear(other: Primaries): Boolean =
    toFloats.lazyZip(other.toFloats).forall((a, b) =>
      Math.abs(a - b) <= 1e-3f * Math.abs(b) + 1e-6f
    )

object Primaries:
  private def xyz(xy: (Double, Double)): Vector[Double] = Vector(xy._1, xy._2, 1 - xy._1 - xy._2)

  def ofFloats(v: Array[Float]): Primaries =
    val Array(r, g, b, w) = v.map(_.toDouble).grouped(2).map(a => (a(0), a(1))).toArray: @unchecked
    Primaries(r, g, b, w)

/** Linear RGB colours of given primaries.
  *
  * A colour describes light as it is, or a reflectance by the colour of the light that it reflects
  * from the space's illuminant: (1, 1, 1) reflects everything in any space. Components may be
  * negative.
  *
  * Sources: PBRT 4th ed., §4.6.3; ITU-R BT.709, BT.2020; SMPTE EG 432-1 (P3 with white D65) and ST
  * 2065-1.
  *
  * @param name       as in pbrt-v4
  * @param illuminant light with the colour of white
  */
final class ColorSpace private (
    val name: String,
    val meaning: String,
    val primaries: Primaries,
    val illuminant: Spectrum,
    val xyzOfRgb: Matrix3,
    val rgbOfXyz: Matrix3
):
  def isSrgb: Boolean = this eq ColorSpace.Srgb

  /** Matrix from light in linear sRGB to this space. */
  lazy val ofSrgb: Matrix3 = rgbOfXyz * ColorSpace.Srgb.xyzOfRgb

  /** Matrix from light in this space to linear sRGB. */
  lazy val toSrgb: Matrix3 = ColorSpace.Srgb.rgbOfXyz * xyzOfRgb

  /** As [[toSrgb]], for reflectances: white stays white. Exact if white is D65; else off by a
    * percent in deep colours, whose spectra it does not know.
    */
  lazy val toSrgbAdapted: Matrix3 =
    ColorSpace.Srgb.rgbOfXyz * adaptation * xyzOfRgb

  lazy val ofSrgbAdapted: Matrix3 = toSrgbAdapted.inverse

  private def adaptation: Matrix3 =
    WhiteBalance.adaptation(white, ColorSpace.Srgb.white)

  private def white: (Double, Double) =
    val xyz = xyzOfRgb * Vector(1.0, 1.0, 1.0)
    (xyz(0) / xyz.sum, xyz(1) / xyz.sum)

  /** Light of this space's colour `c`, in linear sRGB. */
  def light(c: Rgb): Rgb = if isSrgb then c else toSrgb * c

  /** The colour, in linear sRGB, of the light that pbrt-v4 assigns to `c`: another than [[light]]
    * if no smooth spectrum under the illuminant has it.
    */
  def emission(c: Rgb): Rgb =
    val scale = 2f * c.max
    if isSrgb || !(scale > 0f) || Upsampling.isExact(c * (1f / scale), this) then light(c)
    else
      val s = Upsampling.unbounded(c, this)
      var x, y, z = 0.0
      for row <- illuminantXyz do
        val v = s(row(0).toFloat)
        x += v * row(1)
        y += v * row(2)
        z += v * row(3)
      Colorimetry.fromXyz(x, y, z)

  /** Linear sRGB under D65 of the reflectance that pbrt-v4 assigns to `c`. */
  def reflectance(c: Rgb): Rgb =
    if c.max <= 1f then underD65(c, 1f, Upsampling.spectrum(c, this)) else unbounded(c)

  /** As [[reflectance]], of a quantity that may be above 1. */
  def unbounded(c: Rgb): Rgb =
    if c.max > 0f then underD65(c, 2f * c.max, Upsampling.unbounded(c, this)) else Rgb.Black

  /** @param scale that of the colour which was fitted */
  private def underD65(c: Rgb, scale: Float, spectrum: => Float => Float): Rgb =
    def isExact = Upsampling.isExact(c * (1f / scale), this)
    if isSrgb || (c.r == c.g && c.g == c.b) then c
    else if (illuminant eq ColorSpace.Srgb.illuminant) && isExact then toSrgb * c
    else Colorimetry.rgb(spectrum, Colorimetry.White.D65)

  /** X, Y and Z by wavelength (in nm, first) of the illuminant, over the Y of white. */
  private[color] lazy val illuminantXyz: Array[Array[Double]] =
    val nms = Colorimetry.wavelengths
    val y = Colorimetry.observers(1)
    val whiteY = nms.map(nm => (5.0 * y(nm)) * illuminant(nm)).sum
    nms.map: nm =>
      val share = 5 * illuminant(nm) / whiteY
      Array(nm.toDouble) ++ Colorimetry.observers.map(_(nm) * share)

  /** Red, green and blue of each wavelength under the illuminant, one after another. */
  private[color] lazy val responses: Array[Double] =
    illuminantXyz.flatMap(row => rgbOfXyz * Vector(row(1), row(2), row(3)))

  override def toString: String = name

object ColorSpace:
  private val D65 = (0.3127, 0.3290)

  val Srgb: ColorSpace = new ColorSpace(
    "srgb",
    "sRGB: primaries of ITU-R BT.709, white D65",
    Primaries((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), D65),
    Colorimetry.D65,
    Colorimetry.xyzOfRgb,
    Colorimetry.rgbOfXyz
  )

  private def ofD65(name: String, meaning: String)(
      red: (Double, Double),
      green: (Double, Double),
      blue: (Double, Double)
  ) = apply(name, meaning, Primaries(red, green, blue, D65), Colorimetry.D65)

  /** With exactly the white of [[Srgb]], whose published matrix has other digits, if it is D65. */
  private def apply(name: String, meaning: String, primaries: Primaries, illuminant: Spectrum) =
    val isD65 = illuminant eq Colorimetry.D65
    val whiteXyz = if isD65 then Srgb.xyzOfRgb * Vector(1.0, 1.0, 1.0) else primaries.whiteXyz
    val toXyz = primaries.toXyz(whiteXyz)
    new ColorSpace(name, meaning, primaries, illuminant, toXyz, toXyz.inverse)

  /** The spaces of pbrt-v4. */
  val all: Vector[ColorSpace] = Vector(
    Srgb,
    ofD65(
      "dci-p3",
      "primaries of DCI P3, white D65"
    )((0.680, 0.320), (0.265, 0.690), (0.150, 0.060)),
    ofD65("rec2020", "primaries of ITU-R BT.2020, white D65")(
      (0.708, 0.292),
      (0.170, 0.797),
      (0.131, 0.046)
    ),
    apply(
      "aces2065-1",
      "primaries AP0 of SMPTE ST 2065-1, white near D60",
      Primaries((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.0770), (0.32168, 0.33767)),
      NamedSpectra("illum-acesD60").get
    )
  )

  def named(name: String): Option[ColorSpace] = all.find(_.name == name)

  /** The space of the primaries: pbrt-v4's, if they are near, else one of its own, with the
    * illuminant of the nearest white. None if no colours can be made of them.
    */
  def of(primaries: Primaries): Option[ColorSpace] =
    all.find(_.primaries.isNear(primaries)).orElse:
      val toXyz = primaries.toXyz(primaries.whiteXyz)
      val values = toXyz.toFloats ++ toXyz.inverse.toFloats
      Option.when(values.forall(v => Math.abs(v) < 1e3f)):
        val (x, y) = primaries.white
        def distance(s: ColorSpace) =
          Math.hypot(s.primaries.white._1 - x, s.primaries.white._2 - y)
        val illuminant = all.minBy(distance).illuminant
        new ColorSpace("custom", "", primaries, illuminant, toXyz, toXyz.inverse)

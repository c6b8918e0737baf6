package candela.color

/** The three components in which light is multiplied during transport, and how spectra and colours
  * enter and leave them. Either three numbers ([[ColorBasis.Srgb]], [[ColorBasis.Sharp]]) or the
  * values at three wavelengths ([[Wavelengths]]).
  */
abstract class ColorBasis:

  /** Colour of light, in linear sRGB or in the channels of a sensor. */
  def toSrgb(c: Rgb): Rgb

  /** Components of a reflectance with this colour, in linear sRGB. */
  def fromSrgb(c: Rgb): Rgb

  /** As [[fromSrgb]], or [[unbounded]] if a component is above 1: for colours that are known while
    * rendering only.
    */
  def lookUp: Rgb => Rgb

  /** As [[lookUp]], for light: the shape of the spectrum is the same for all brightnesses. */
  def lookUpLight: Rgb => Rgb = lookUp

  /** Components of light with this colour. */
  def ofLight(c: Rgb): Rgb

  /** Components of a non-negative quantity without upper bound, such as a coefficient. */
  def unbounded(c: Rgb): Rgb

  /** Components of a reflectance, given by wavelength in nm. */
  def ofReflectance(s: Float => Float): Rgb

  /** A reflectance by wavelength that has these components. */
  def reflectance(c: Rgb): Float => Float

  /** Components of a spectrum of light. The two arguments are the same light: by wavelength, and
    * its colour in linear sRGB.
    */
  def ofLight(s: Float => Float, color: Rgb): Rgb

  /** Whether components are those of sRGB. */
  def isSrgb: Boolean = false

  /** Whether components are values at wavelengths. */
  def isSpectral: Boolean = false

object ColorBasis:
  private val identity = Array(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f)

  /** The components of sRGB: how pbrt-v2 and v3 multiply colours. */
  val Srgb: ColorBasis = ThreeNumbers(identity, identity)

  /** For pbrt-v4, a spectral renderer. Fitted to the spectral products of a light and up to four
    * surfaces, with smooth spectra of mostly low saturation. Over 1,200 such products its error is
    * 4.7 % of a channel (root mean square; sRGB: 7.4 %), on average 0.1 % in blue (sRGB: 2.0 %).
    * Every sRGB colour has non-negative components.
    */
  val Sharp: ColorBasis = ofRows(
    Array(
      1.179232f, -0.148391f, -0.030841f, //
      -0.064328f, 1.146899f, -0.082571f, //
      -0.025433f, -0.066425f, 1.091858f
    )
  )

  private def ofRows(m: Array[Float]): ColorBasis =
    ThreeNumbers(m, Matrix3(m.map(_.toDouble).toVector).inverse.toFloats)

  private[color] def times(m: Array[Float], c: Rgb): Rgb = Rgb(
    m(0) * c.r + m(1) * c.g + m(2) * c.b,
    m(3) * c.r + m(4) * c.g + m(5) * c.b,
    m(6) * c.r + m(7) * c.g + m(8) * c.b
  )

  /** A linear map to and from linear sRGB that preserves white (1, 1, 1).
    *
    * Light scatters per wavelength, and the product of two colours' spectra has another colour than
    * the product of their sRGB components: colours drift with every bounce. A basis with sharper
    * primaries drifts less, at no cost per ray.
    *
    * Source of the idea: Ward and Eydelberg-Vileshin, "Picture Perfect RGB Rendering Using Spectral
    * Prefiltering and Sharp Color Primaries", Eurographics Workshop on Rendering 2002.
    *
    * @param toRows nine numbers in row order: the matrix to sRGB
    */
  private final class ThreeNumbers(toRows: Array[Float], fromRows: Array[Float]) extends ColorBasis:
    def toSrgb(c: Rgb): Rgb = times(toRows, c)
    def fromSrgb(c: Rgb): Rgb = times(fromRows, c)
    def lookUp: Rgb => Rgb = fromSrgb(_)
    def ofLight(c: Rgb): Rgb = fromSrgb(c)
    def unbounded(c: Rgb): Rgb = fromSrgb(c)
    def ofReflectance(s: Float => Float): Rgb =
      fromSrgb(Colorimetry.rgb(s, Colorimetry.White.D65))
    def ofLight(s: Float => Float, color: Rgb): Rgb = fromSrgb(color)
    def reflectance(c: Rgb): Float => Float = Upsampling.spectrum(toSrgb(c))
    override val isSrgb: Boolean = toRows.sameElements(identity)

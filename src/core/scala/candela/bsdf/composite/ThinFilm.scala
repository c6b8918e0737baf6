package candela.bsdf.composite

import candela.color.{ColorBasis, Rgb, Wavelengths}
import candela.math.*

/** A thin film on a surface: light reflected by it interferes with light reflected beneath it.
  *
  * Source: KHR_materials_iridescence, after Belcour and Barla, "A Practical Extension to Microfacet
  * Theory for the Modeling of Varying Iridescence", SIGGRAPH 2017. Reflectances are those of
  * Schlick's approximation, two orders of interference count, and indices beneath the film are
  * those of dielectrics with the same reflectance.
  *
  * @param weight    0: no film, 1: film everywhere
  * @param eta       index of refraction of the film
  * @param thickness in nm
  */
private final class ThinFilm(weight: Float, eta: Float, thickness: Float, colors: FilmColors):

  /** The reflectance of a surface with this film.
    *
    * @param bare   that of the surface alone
    * @param normal that at normal incidence
    */
  def coated(bare: Rgb, normal: Rgb, cosTheta: Float): Rgb =
    bare * (1f - weight) + colors.reflectance(eta, thickness, normal, Math.abs(cosTheta)) * weight

/** How the interference of all wavelengths is seen. */
abstract class FilmColors:

  /** In the components of transport, within [0, 1].
    *
    * @param normal reflectance at normal incidence of what is beneath the film
    */
  def reflectance(eta: Float, thickness: Float, normal: Rgb, cosTheta: Float): Rgb

  /** Means of the cosines of a phase, over the sensitivity of each component.
    *
    * @param path  optical path difference in nm
    * @param shift of the phase in addition to that, of each component
    */
  protected def cosines(path: Float, shift: Rgb): Rgb

  protected final def interference(
      eta: Float,
      thickness: Float,
      normal: Rgb,
      cosTheta: Float
  ): Rgb =
    val cos2 = 1f - (1f - square(cosTheta)) / square(eta)
    if cos2 < 0f then Rgb.White
    else
      val cosInside = sqrt(cos2)
      val outer = schlick(square((eta - 1f) / (eta + 1f)), cosTheta)
      val passed = 1f - outer
      // Below the film
      val index = normal.map: f =>
        val root = sqrt(clamp(f, 0f, FilmColors.MaxReflectance))
        (1f + root) / (1f - root)
      val inner = index.map(n => schlick(square((n - eta) / (n + eta)), cosInside))
      val shift = index.map(n => (if eta < 1f then 0f else Pi) + (if n < eta then Pi else 0f))
      val product = (inner * outer).map(clamp(_, 1e-5f, FilmColors.MaxReflectance))
      val amplitude = product.map(sqrt(_))
      val returned = inner * square(passed) * product.map(x => 1f / (1f - x))
      var sum = returned + Rgb.gray(outer)
      var order = returned - Rgb.gray(passed)
      val path = 2f * eta * thickness * cosInside
      var m = 1
      while m <= FilmColors.Orders do
        order = order * amplitude
        sum = sum + order * cosines(m * path, shift * m.toFloat) * 2f
        m += 1
      sum.map(clamp(_, 0f, 1f))

  private def schlick(normal: Float, cosTheta: Float): Float =
    normal + (1f - normal) * Schlick.weight(cosTheta)

object FilmColors:
  private inline val Orders = 2

  /** Nearer to 1, indices have no bounds. */
  private inline val MaxReflectance = 0.9999f

  def of(basis: ColorBasis): FilmColors = basis match
    case wavelengths: Wavelengths => OfWavelengths(wavelengths)
    case numbers => OfNumbers(numbers)

  /** Each component is a wavelength. */
  private final class OfWavelengths(light: Wavelengths) extends FilmColors:
    private val turns = Rgb(1f / light.nm(0), 1f / light.nm(1), 1f / light.nm(2)) * TwoPi

    def reflectance(eta: Float, thickness: Float, normal: Rgb, cosTheta: Float): Rgb =
      interference(eta, thickness, normal, cosTheta)

    protected def cosines(path: Float, shift: Rgb): Rgb = (turns * path + shift).map(cos(_))

  /** The colour matching functions are sums of Gaussians, whose Fourier transforms are known; X, Y
    * and Z become linear sRGB.
    */
  private final class OfNumbers(basis: ColorBasis) extends FilmColors:
    def reflectance(eta: Float, thickness: Float, normal: Rgb, cosTheta: Float): Rgb =
      if basis.isSrgb then interference(eta, thickness, normal, cosTheta)
      else basis.fromSrgb(interference(eta, thickness, basis.toSrgb(normal), cosTheta))

    protected def cosines(path: Float, shift: Rgb): Rgb =
      val phase = TwoPi * path * 1e-9f
      def lobe(scale: Float, position: Float, variance: Float, shift: Float) =
        scale / Unit * sqrt(TwoPi * variance) * cos(position * phase + shift) *
          exp(-square(phase) * variance)
      val x = lobe(5.4856e-13f, 1.6810e+06f, 4.3278e+09f, shift.r) +
        lobe(9.7470e-14f, 2.2399e+06f, 4.5282e+09f, shift.r)
      val y = lobe(4.4201e-13f, 1.7953e+06f, 9.3046e+09f, shift.g)
      val z = lobe(5.2481e-13f, 2.2084e+06f, 6.6121e+09f, shift.b)
      Rgb(
        3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
        -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
        0.0556434f * x - 0.2040259f * y + 1.0572252f * z
      )

  /** The integral of the matching functions. */
  private inline val Unit = 1.0685e-7f

package candela.color

import candela.base.loop

/** Light or a reflectance: its spectrum, and the three numbers that stand for it.
  *
  * @param values at the wavelengths of [[ColorError.wavelengths]]; light relative to D65
  */
final class ColoredSpectrum(val values: Array[Double], val components: Rgb):

  /** The values, relative to the largest. */
  def shape: Array[Double] =
    val largest = values.max
    values.map(_ / largest)

object ColoredSpectrum:
  /** The sum of all differences, or of some that are no less than `limit` together. */
  def distance(
      a: Array[Double],
      b: Array[Double],
      limit: Double = Double.PositiveInfinity
  ): Double =
    var sum = 0.0
    var i = 0
    while i < a.length && sum < limit do
      sum += Math.abs(a(i) - b(i))
      i += 1
    sum

/** Error of three-number colour: light and surfaces are multiplied as spectra, and as the
  * components of a basis.
  *
  * The model is a surface in a closed cavity, which sees the light of the others: for each light L,
  * each reflectance a, and each b that may prevail around it, the light of L·a·(1 + m + m² + …),
  * where m is the mean of b and of all reflectances; and the same without the first term, for a
  * surface in the shade. The bound is the largest error of a channel over all of them, relative to
  * the channel or to a twentieth of the brightest one, times a margin for rooms in which more of
  * one colour comes together.
  */
object ColorError:
  /** In nm. */
  def wavelengths: Array[Float] = Colorimetry.wavelengths

  /** Share of the brightest channel below which a channel's error is measured against that. */
  val Floor = 0.05

  /** Upper bound of the relative error of a channel.
    *
    * @param depth number of scattering events of a path, at most
    */
  def bound(
      lights: Seq[ColoredSpectrum],
      surfaces: Seq[ColoredSpectrum],
      basis: ColorBasis,
      depth: Int
  ): Double =
    val colors = if surfaces.isEmpty then Seq(Grey) else surfaces
    val mean = mixed(colors.map(_ -> 1.0 / colors.size)*)
    val cavities =
      for
        b <- colors
        m = mixed(b -> Prevailing, mean -> (1 - Prevailing))
        first <- Seq(0, 1) if first < depth
      yield gathered(m, first, depth)
    val errors = for light <- lights; a <- colors; m <- cavities yield error(light, a, m, basis)
    Margin * errors.maxOption.getOrElse(0.0)

  /** Share of the one colour that prevails around a surface. */
  private val Prevailing = 0.3

  private val Margin = 1.2

  private def mixed(weighted: (ColoredSpectrum, Double)*): ColoredSpectrum =
    val values = wavelengths.indices.map(w => weighted.map((s, share) => s.values(w) * share).sum)
    val components = weighted.map((s, share) => s.components * share.toFloat).reduce(_ + _)
    ColoredSpectrum(values.toArray, components)

  private val Grey = ColoredSpectrum(wavelengths.map(_ => 0.5), Rgb.gray(0.5f))

  /** Light that reaches a surface in a cavity of `m`, of unit light. */
  private def gathered(m: ColoredSpectrum, first: Int, depth: Int): ColoredSpectrum =
    ColoredSpectrum(
      m.values.map(series(_, first, depth)),
      m.components.map(c => series(c, first, depth).toFloat)
    )

  private def error(
      light: ColoredSpectrum,
      a: ColoredSpectrum,
      cavity: ColoredSpectrum,
      basis: ColorBasis
  ): Double =
    val spectrum = Array.tabulate(light.values.length): w =>
      light.values(w) * a.values(w) * cavity.values(w)
    difference(spectrum, basis.toSrgb(light.components * a.components * cavity.components))

  /** Σ b^k for k from `first` to `depth` − 1. */
  private def series(b: Double, first: Int, depth: Int): Double =
    var sum = 0.0
    for _ <- first until depth do sum = 1 + b * sum
    sum * Math.pow(b, first)

  /** Largest relative difference of a channel. */
  def difference(spectrum: Array[Double], color: Rgb): Double =
    val exact = srgb(spectrum)
    val minMagnitude = Floor * exact.map(Math.abs).max
    if !(minMagnitude > 0) then 0.0
    else
      Seq(color.r, color.g, color.b).zip(exact)
        .map((c, e) => Math.abs(c - e) / Math.max(Math.abs(e), minMagnitude)).max

  /** Largest error of a channel, relative to the brightest one, if the spectra of lights, and of
    * surfaces in white light, are known at the wavelengths of `bases` only: narrow lines need many.
    */
  def ofWavelengths(
      bases: Seq[Wavelengths],
      lights: Seq[ColoredSpectrum],
      surfaces: Seq[ColoredSpectrum]
  ): Double =
    val errors =
      for s <- lights ++ surfaces yield
        val spectrum = light(s.values)
        val sum = bases.map(b => b.toSrgb(b.ofReflectance(spectrum(_).toFloat))).reduce(_ + _)
        val exact = srgb(s.values)
        val deviation =
          sum * (1f / bases.size) - Rgb(exact(0).toFloat, exact(1).toFloat, exact(2).toFloat)
        deviation.largest / exact.map(Math.abs).max
    errors.maxOption.getOrElse(0.0)

  /** Light at a wavelength in nm, from its values relative to D65. */
  def light(relative: Array[Double]): Float => Double =
    // Linear between the values of the light itself, as tables are
    val values = wavelengths.lazyZip(relative).map((nm, v) => v * Colorimetry.D65(nm))
    nm =>
      val x = (nm - wavelengths.head) / (wavelengths(1) - wavelengths(0))
      val i = Math.max(0, Math.min(x.toInt, values.length - 2))
      values(i) + (x - i) * (values(i + 1) - values(i))

  /** Luminance of a spectrum of light relative to D65. */
  def luminance(spectrum: Array[Double]): Double =
    val c = srgb(spectrum)
    0.2126 * c(0) + 0.7152 * c(1) + 0.0722 * c(2)

  /** Linear sRGB of a spectrum of light relative to D65. */
  def srgb(spectrum: Array[Double]): Array[Double] =
    val sums = new Array[Double](3)
    loop(spectrum.length): w =>
      loop(3)(c => sums(c) += Colorimetry.shares(3 * w + c) * spectrum(w))
    sums

package candela.color

import candela.base.loop

/** Light or a reflectance: its spectrum, and the three numbers that stand for it.
  *
  * @param values at the wavelengths of [[ColorError.wavelengths]]; light relative to D65
  */
final class ColoredSpectrum(val values: Array[Double], val components: Rgb):

  /** The values, relative to the largest. */
  def shape: Array[Double] =
    val most = values.max
    values.map(_ / most)

object ColoredSpectrum:
  /** The sum of all differences, or of some that are no less than `most` together. */
  def distance(
      a: Array[Double],
      b: Array[Double],
      most: Double = Double.PositiveInfinity
  ): Double =
    var sum = 0.0
    var i = 0
    while i < a.length && sum < most do
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
    val all = if surfaces.isEmpty then Seq(Grey) else surfaces
    val mean = mixed(all.map(_ -> 1.0 / all.size)*)
    val around =
      for
        b <- all
        m = mixed(b -> Prevailing, mean -> (1 - Prevailing))
        first <- Seq(0, 1) if first < depth
      yield gathered(m, first, depth)
    val errors = for light <- lights; a <- all; m <- around yield error(light, a, m, basis)
    Margin * errors.maxOption.getOrElse(0.0)

  /** Share of the one colour that prevails around a surface. */
  private val Prevailing = 0.3

  private val Margin = 1.2

  private def mixed(parts: (ColoredSpectrum, Double)*): ColoredSpectrum =
    val values = wavelengths.indices.map(w => parts.map((s, share) => s.values(w) * share).sum)
    val components = parts.map((s, share) => s.components * share.toFloat).reduce(_ + _)
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
      around: ColoredSpectrum,
      basis: ColorBasis
  ): Double =
    val spectrum = Array.tabulate(light.values.length): w =>
      light.values(w) * a.values(w) * around.values(w)
    difference(spectrum, basis.toSrgb(light.components * a.components * around.components))

  /** Σ b^k for k from `first` to `depth` − 1. */
  private def series(b: Double, first: Int, depth: Int): Double =
    var sum = 0.0
    for _ <- first until depth do sum = 1 + b * sum
    sum * Math.pow(b, first)

  /** Largest relative difference of a channel. */
  def difference(spectrum: Array[Double], color: Rgb): Double =
    val exact = seen(spectrum)
    val least = Floor * exact.map(Math.abs).max
    if !(least > 0) then 0.0
    else
      Seq(color.r, color.g, color.b).zip(exact)
        .map((c, e) => Math.abs(c - e) / Math.max(Math.abs(e), least)).max

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
        val known = light(s.values)
        val sum = bases.map(b => b.toSrgb(b.ofReflectance(known(_).toFloat))).reduce(_ + _)
        val exact = seen(s.values)
        val off =
          sum * (1f / bases.size) - Rgb(exact(0).toFloat, exact(1).toFloat, exact(2).toFloat)
        off.largest / exact.map(Math.abs).max
    errors.maxOption.getOrElse(0.0)

  /** Light at a wavelength in nm, from its values relative to D65. */
  def light(relative: Array[Double]): Float => Double =
    // Linear between the values of the light itself, as tables are
    val all = wavelengths.lazyZip(relative).map((nm, v) => v * Colorimetry.D65(nm))
    nm =>
      val x = (nm - wavelengths.head) / (wavelengths(1) - wavelengths(0))
      val i = Math.max(0, Math.min(x.toInt, all.length - 2))
      all(i) + (x - i) * (all(i + 1) - all(i))

  /** Luminance of a spectrum of light relative to D65. */
  def luminance(spectrum: Array[Double]): Double =
    val c = seen(spectrum)
    0.2126 * c(0) + 0.7152 * c(1) + 0.0722 * c(2)

  /** Linear sRGB of a spectrum of light relative to D65. */
  def seen(spectrum: Array[Double]): Array[Double] =
    val sums = new Array[Double](3)
    loop(spectrum.length): w =>
      loop(3)(c => sums(c) += Colorimetry.shares(3 * w + c) * spectrum(w))
    sums

package candela.color

/** The components of light at three wavelengths: a hero and two companions a third of the visible
  * range away, in the measure of the detector's sensitivity.
  *
  * A spectral image is the mean over a set of such bases that covers the range
  * ([[Wavelengths.covering]]); each camera path uses one of them.
  *
  * Source: Wilkie et al., "Hero Wavelength Spectral Sampling", EGSR 2014.
  *
  * @param nm      the wavelengths; the first is the hero
  * @param weights widths of the spectrum that they stand for, in nm
  * @param rows    nine numbers in row order: the matrix to the detector's channels
  * @param smooth  spectra of colours
  */
final class Wavelengths private (
    val nm: Array[Float],
    weights: Array[Float],
    rows: Array[Float],
    smooth: SmoothSpectra
) extends ColorBasis:
  private val daylight = evaluate(Colorimetry.D65(_))

  override def isSpectral: Boolean = true

  /** Width of the spectrum that a wavelength stands for, in nm. */
  def weight(i: Int): Float = weights(i)

  def toSrgb(c: Rgb): Rgb = ColorBasis.times(rows, c)

  /** Smooth spectra; those of greys are constant, and of brighter colours unbounded. */
  def fromSrgb(c: Rgb): Rgb =
    if isGrey(c) then c else if c.max > 1f then unbounded(c) else evaluate(smooth.exact(c))

  def unbounded(c: Rgb): Rgb =
    val scale = 2f * c.max
    if isGrey(c) || !(scale > 0f) then c else evaluate(smooth.exact(c * (1f / scale))) * scale

  def lookUp: Rgb => Rgb =
    val table = smooth.table
    c =>
      val maximum = c.max
      if isGrey(c) || !(maximum > 0f) then c
      else if maximum <= 1f then table.at(c.r, c.g, c.b, nm(0), nm(1), nm(2))
      else bright(table, c)

  override def lookUpLight: Rgb => Rgb =
    val table = smooth.table
    c => if isGrey(c) || !(c.max > 0f) then c else bright(table, c)

  /** Half as bright as can be, times what is left. */
  private def bright(table: SpectrumTable, c: Rgb): Rgb =
    val s = 0.5f / c.max
    table.at(c.r * s, c.g * s, c.b * s, nm(0), nm(1), nm(2)) * (2f * c.max)

  private def isGrey(c: Rgb): Boolean = c.r == c.g && c.g == c.b

  /** Daylight (D65), filtered by a smooth spectrum. */
  def ofLight(c: Rgb): Rgb = unbounded(c) * daylight

  def ofReflectance(s: Float => Float): Rgb = evaluate(s)

  def reflectance(c: Rgb): Float => Float =
    wavelength => if wavelength == nm(0) then c.r else if wavelength == nm(1) then c.g else c.b

  /** Scaled to the luminance of `color`. */
  def ofLight(s: Float => Float, color: Rgb): Rgb =
    val luminance = Wavelengths.luminance(s)
    if luminance > 0f then evaluate(s) * (color.luminance / luminance) else Rgb.Black

  private def evaluate(s: Float => Float): Rgb = Rgb(s(nm(0)), s(nm(1)), s(nm(2)))

object Wavelengths:
  private inline val FirstNm = 360
  private inline val LastNm = 830

  /** Share of the wavelengths that are sampled uniformly, whatever the sensitivity. */
  val Uniform = 0.02

  /** Brightness of a channel, relative to the brightest, below which its noise counts less. */
  private val Dim = 0.1

  /** Spectral radiance, in pbrt-v4's unit, of a unit of light; [[Colorimetry.radianceOfD65]]. */
  val Radiance: Double = Colorimetry.radianceOfD65(560f) / Colorimetry.D65(560f).toDouble

  /** Luminance of a spectrum of light, where D65 has luminance 1. */
  private def luminance(s: Float => Float): Float =
    val y = Colorimetry.observers(1)
    val sum = (FirstNm to LastNm).map(nm => s(nm.toFloat).toDouble * y(nm.toFloat)).sum
    (sum / Colorimetry.luminanceOfD65).toFloat

  /** Linear sRGB, by the standard observer: for each wavelength, its channels. */
  val Observer: Float => Array[Double] = nm =>
    (Colorimetry.rgbOfXyz * Colorimetry.observers.map(_(nm).toDouble)).toArray

  /** Bases that cover the visible range `count` times three wavelengths, stratified by what the
    * detector's channels see of the scene's light. Channels count alike, unless they see little.
    *
    * @param light    spectrum of the scene's light
    * @param detector response of its three channels to a unit of light at a wavelength in nm, in
    *                 units in which D65 has the luminance that [[Colorimetry.luminanceOfD65]] says
    * @param uniform  share of the wavelengths that are spread evenly instead
    */
  def covering(
      count: Int,
      smooth: SmoothSpectra,
      light: Float => Double = Colorimetry.D65(_).toDouble,
      detector: Float => Array[Double] = Observer,
      uniform: Double = Uniform
  ): Vector[Wavelengths] =
    val centres = Array.tabulate(LastNm - FirstNm)(FirstNm + _ + 0.5f)
    def detected(light: Float => Double) = Array.tabulate(3): c =>
      centres.map(nm => Math.abs(detector(nm)(c)) * light(nm)).sum
    val bright = detected(light).lazyZip(detected(Colorimetry.D65(_))).map(_ / _)
    val shares = bright.map(b => 1 / Math.max(b, Dim * bright.max))
    val strength = centres.map: nm =>
      detector(nm).lazyZip(shares).map((r, share) => Math.abs(r) * share).sum * light(nm)
    val mean = strength.sum / strength.length
    val density = strength.map(s =>
      (1 - uniform) * s / (mean * strength.length) +
        uniform / strength.length
    )
    val below = density.scanLeft(0.0)(_ + _)

    /** The wavelength below which lies the share `u` of the sensitivity, and its density per nm. */
    def sample(u: Double): (Float, Double) =
      val target = u * below.last
      val position = java.util.Arrays.binarySearch(below, target)
      val i = Math.min(if position >= 0 then position else -position - 2, density.length - 1)
      ((FirstNm + i + (target - below(i)) / density(i)).toFloat, density(i) / below.last)

    val sets = Vector.tabulate(count): k =>
      val u = (k + 0.5) / count
      Vector.tabulate(3)(i => sample((u + i / 3.0) % 1.0))
    def response(nm: Float, pdf: Double) =
      detector(nm).map(_ / (3 * pdf * Colorimetry.luminanceOfD65))
    // What the finite set makes of the light, corrected to what an integral would make of it
    val exact = Array.tabulate(3): c =>
      (FirstNm to LastNm).map(nm =>
        detector(nm.toFloat)(c) * light(nm.toFloat) / Colorimetry.luminanceOfD65
      ).sum
    val approximate = Array.tabulate(3): c =>
      sets.flatten.map((nm, pdf) => response(nm, pdf)(c) * light(nm)).sum / count
    for set <- sets yield
      val columns = set.map(response(_, _))
      val rows = Array.tabulate(9): i =>
        (columns(i % 3)(i / 3) * exact(i / 3) / approximate(i / 3)).toFloat
      val widths = set.map((_, pdf) => (1 / (3 * pdf)).toFloat)
      new Wavelengths(set.map(_._1).toArray, widths.toArray, rows, smooth)

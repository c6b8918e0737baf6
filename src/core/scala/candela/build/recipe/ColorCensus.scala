package candela.build.recipe

import candela.base.loop
import candela.concurrency.Parallel
import scala.collection.mutable

import candela.color.{ColorBasis, ColorError, ColoredSpectrum, Rgb, SmoothSpectra}
import candela.textures.ColorChoice

/** The spectra that a scene is built from, collected as recipes read them, to decide whether three
  * numbers render its colours.
  *
  * Spectra are fitted when they are asked for, by all threads.
  *
  * @param basis the three numbers
  */
final class ColorCensus(basis: ColorBasis, pool: Parallel = Parallel.Alone):
  import ColorCensus.*

  private val emitted, reflected = mutable.LinkedHashMap.empty[Any, () => ColoredSpectrum]
  private val cells = java.util.BitSet()
  private val outerCells = mutable.HashSet.empty[(Boolean, Rgb)]
  private val remarks = mutable.ArrayBuffer.empty[() => Unit]
  private var disperses = false
  private var detector: Option[String] = None
  private var bandCount: Option[Int] = None

  /** Some that are far apart, of all that were noted: to be asked for after that. */
  lazy val lights: Vector[ColoredSpectrum] = farApart(emitted.values.toVector, pool)
  lazy val surfaces: Vector[ColoredSpectrum] = farApart(reflected.values.toVector, pool)

  /** Spectrum of the scene's light: of all emitters alike, since what each lights is not known, and
    * of some daylight, for what surfaces make of it.
    */
  def light: Float => Double =
    val normalized =
      for l <- lights.map(_.values); y = ColorError.luminance(l) if y > 0 yield l.map(_ / y)
    val mean = ColorError.wavelengths.indices.map: w =>
      if normalized.isEmpty then 1.0
      else Daylight + (1 - Daylight) * normalized.map(_(w)).sum / normalized.size
    ColorError.light(mean.toArray)

  /** What is to be said of a material if the scene is rendered in wavelengths: those of their sets
    * are made while rendering.
    */
  def ifSpectral(say: () => Unit): Unit = remarks += say

  def sayOfSpectral(): Unit = remarks.foreach(_())

  /** A material disperses light. */
  def addDispersion(): Unit = disperses = true

  /** Whether a material disperses light. */
  def isDispersive: Boolean = disperses

  /** The film responds to spectra, not to colours. */
  def addDetector(what: String): Unit = detector = Some(what)

  /** The film has wavelength bands. */
  def addBands(count: Int): Unit =
    bandCount = Some(count)
    addDetector("the film has wavelength bands")
  def bands: Option[Int] = bandCount
  def detectors: Option[String] = detector

  /** A value and the three numbers that stand for it. */
  def add(value: SpectralValue, role: SpectrumRole, components: Rgb): Unit = value match
    case SpectralValue.Color(c, space) if space.isSrgb => add(c, role, components)
    case SpectralValue.Color(c, space) if role == SpectrumRole.Emission =>
      add(space.emission(c), role, components)
    case SpectralValue.Color(c, space) if role == SpectrumRole.Unbounded =>
      add(space.unbounded(c), role, components)
    case SpectralValue.Color(c, space) => add(space.reflectance(c), role, components)
    case SpectralValue.Wavelengths(s) => add(s, role, s(_), components)

  /** An image in linear sRGB: some of its pixels. */
  def addImage(pixels: Int, role: SpectrumRole)(color: Int => Rgb): Unit =
    addColors(ofImage(pixels)(color), role)

  /** Colours that stand for those of an image. */
  def addColors(some: Vector[Rgb], role: SpectrumRole): Unit =
    for c <- some do add(c, role, basis.fromSrgb(c))

  /** A reflectance by wavelength in nm. */
  def addReflectance(key: Any, s: Float => Float): Unit =
    lazy val components = basis.ofReflectance(s)
    add(key, SpectrumRole.Reflectance, s, components)

  private def add(c: Rgb, role: SpectrumRole, components: Rgb): Unit =
    val isGrey = (c - Rgb.gray(c.g)).largest <= 1e-4f * c.g
    if c.isFinite && c.max > 0f then
      // Half as bright as can be, as in pbrt-v4
      lazy val dimmed = SmoothSpectra.spectrum(c * (0.5f / c.max))
      val smooth = (nm: Float) => if isGrey then c.g else dimmed(nm) * 2f * c.max
      role match
        case SpectrumRole.Emission =>
          val full = c * (1f / c.max)
          note(emitted, full, full)(smooth, components)
        case SpectrumRole.Unbounded => addCoefficient(c, smooth, components)
        case SpectrumRole.Reflectance if isCrowded(c) => ()
        case SpectrumRole.Reflectance =>
          def bounded = if !isGrey && c.max <= 1f then SmoothSpectra.spectrum(c) else smooth
          note(reflected, c, c)(bounded, components)

  /** Of very many spectra, no two whose colours are in the same cell of a grid are noted: they
    * would not be far apart.
    */
  private def note(noted: mutable.Map[Any, () => ColoredSpectrum], key: Any, c: => Rgb)(
      s: => Float => Float,
      components: => Rgb
  ): Unit =
    if !noted.contains(key) && (noted.size < MaxNoted || fillsCell(noted eq emitted, c)) then
      noted(key) = () =>
        val smooth = s
        ColoredSpectrum(ColorError.wavelengths.map(smooth(_).toDouble), components)

  /** Whether a reflectance is like one of very many that are noted. */
  private def isCrowded(c: Rgb): Boolean =
    reflected.size >= MaxNoted && {
      val cell = cellOf(c)
      cell >= 0 && cells.get(2 * cell)
    }

  /** Whether the colour is the first in its cell, which then has one. */
  private def fillsCell(isEmitted: Boolean, c: Rgb): Boolean =
    val cell = cellOf(c)
    if cell < 0 then outerCells.add((isEmitted, c.map(x => Math.floor(x * Cells).toFloat)))
    else
      val bit = 2 * cell + (if isEmitted then 1 else 0)
      val isFirst = !cells.get(bit)
      cells.set(bit)
      isFirst

  /** Of a colour with components in [0, 1]; else −1. */
  private def cellOf(c: Rgb): Int =
    def isWithin(x: Float) = x >= 0f && x <= 1f
    def along(x: Float) = (x * Cells).toInt
    if isWithin(c.r) && isWithin(c.g) && isWithin(c.b) then
      (along(c.r) * (Cells + 1) + along(c.g)) * (Cells + 1) + along(c.b)
    else -1

  private def add(key: Any, role: SpectrumRole, s: Float => Float, components: => Rgb): Unit =
    role match
      case SpectrumRole.Emission =>
        val values =
          ColorError.wavelengths.map(nm => (s(nm) / candela.color.Colorimetry.D65(nm)).toDouble)
        // Scaled to the luminance of the components
        val luminance = ColorError.luminance(values)
        val scale = if luminance > 0 then basis.toSrgb(components).luminance / luminance else 0.0
        val _ = emitted.getOrElseUpdate(
          key,
          () => ColoredSpectrum(values.map(_ * scale), components)
        )
      case SpectrumRole.Unbounded => addCoefficient(key, s, components)
      case SpectrumRole.Reflectance =>
        note(reflected, key, components)(s, components)

  /** Transmittance where the mean coefficient leaves 1/e. */
  private def addCoefficient(key: Any, s: Float => Float, components: Rgb): Unit =
    val values = ColorError.wavelengths.map(s(_).toDouble)
    val mean = values.sum / values.length
    if mean > 0 then
      val through = components.map(c => Math.exp(-c / mean).toFloat)
      val _ = reflected.getOrElseUpdate(
        ("coefficient", key),
        () => ColoredSpectrum(values.map(v => Math.exp(-v / mean)), through)
      )

object ColorCensus:
  /** Share of daylight in [[ColorCensus.light]]. */
  private val Daylight = 0.2

  /** Up to this number, all colours are noted; of others, one in each cell of a grid. */
  private val MaxNoted = 4096
  private val Cells = 16

  /** Number of spectra of which all pairs are compared. */
  private val MaxCompared = 24

  /** Pixels that stand for the colours of an image. */
  private val PixelsOfImage = 1000

  /** Colours that stand for those of an image in linear sRGB. */
  def ofImage(pixels: Int)(color: Int => Rgb): Vector[Rgb] =
    val choice = choiceOf(pixels)
    choice.choose(0.until(pixels, choice.step).map(color).toVector)

  /** How they are chosen. */
  def choiceOf(pixels: Long): ColorChoice =
    ColorChoice(Math.max(1L, pixels / PixelsOfImage).toInt, MaxCompared, farApartColors)

  private def farApart(
      all: Vector[() => ColoredSpectrum],
      pool: Parallel
  ): Vector[ColoredSpectrum] =
    // Scenes have thousands of colours
    val shapes = pool.map(all.size): i =>
      val s = all(i)()
      s -> s.shape
    spread(shapes.toVector)((a, b, most) => ColoredSpectrum.distance(a._2, b._2, most)).map(_._1)

  private def farApartColors(all: Vector[Rgb]): Vector[Rgb] =
    spread(all.distinct)((a, b, _) => (a - b).largest.toDouble)

  /** A subset whose members are far from each other, greedily (Gonzalez 1985).
    *
    * @param distance need not be exact from the third argument on
    */
  private inline def spread[T](all: Vector[T])(
      inline distance: (T, T, Double) => Double
  ): Vector[T] =
    if all.size <= MaxCompared then all
    else
      val chosen = Vector.newBuilder[T]
      val nearest = Array.fill(all.size)(Double.PositiveInfinity)
      var count = 0
      var next = 0
      while count < MaxCompared do
        chosen += all(next)
        count += 1
        val last = all(next)
        next = 0
        loop(nearest.length): i =>
          nearest(i) = Math.min(nearest(i), distance(all(i), last, nearest(i)))
          if nearest(i) > nearest(next) then next = i
      chosen.result()

package candela.convert

import candela.base.loop
import candela.diagnostics.{Code, Problem, SourcePos}
import scala.collection.mutable
import scala.util.Try

import candela.color.{ColorError, ColoredSpectrum, Rgb, SmoothSpectra}
import candela.image.ImageFiles
import candela.scenefile.{Declaration, Param, ParamType, SceneDescription}

/** What becomes of colours where pbrt-v4 multiplies spectra instead of three numbers. It considers
  * single reflections, of the light of each emitter and off each surface, and the albedos of media.
  */
private[convert] object SpectralColors:

  /** Names the reflection whose colour differs most, if it does visibly.
    *
    * @param from the program that multiplies three numbers
    * @param visible the least difference of a channel that is reported
    */
  def warning(
      scene: SceneDescription,
      from: String,
      visible: Double = Visible
  ): Option[Problem] =
    val census = Census()
    val _ = Declarations.map(scene): d =>
      census.add(d)
      d
    census.worst.filter(_.error > visible).map: difference =>
      val percent = Math.round(difference.error * 100)
      Problem.warning(
        Code.ShiftedColors,
        difference.surface.pos,
        s"pbrt-v4 multiplies spectra, $from red, green and blue: this colour differs by up to " +
          s"$percent % of the brightest channel, and by more after several reflections",
        Some(s"in the light of ${difference.light.pos}").filter(_ =>
          difference.light.pos != difference.surface.pos
        )
      )

  /** Difference of a channel. */
  private val Visible = 0.005

  /** The same for scenes of pbrt-v2 and v3, most of which are not meant to be exact. */
  val Plain = 0.02

  private final class LocatedColor(val color: ColoredSpectrum, val pos: SourcePos)
  private final class Difference(
      val error: Double,
      val surface: LocatedColor,
      val light: LocatedColor
  )

  private final class Census:
    private val lights, surfaces = mutable.LinkedHashMap.empty[Rgb, LocatedColor]

    def worst: Option[Difference] =
      val surfaceColors = surfaces.values.toVector
      val pairs =
        for
          surface <- surfaceColors.iterator
          light <- lights.valuesIterator ++ surfaceColors.iterator ++ Iterator(LocatedColor(
            White,
            surface.pos
          ))
        yield Difference(error(surface.color, light.color), surface, light)
      pairs.maxByOption(_.error)

    def add(d: Declaration): Unit = d.category match
      case "LightSource" | "AreaLightSource" =>
        for p <- d.params if p.name == "L" || p.name == "I"; c <- constant(p) if c.max > 0 do
          remember(lights, c * (0.5f / c.max), p)
      case "Material" =>
        for p <- d.params if Reflecting(p.name); c <- constant(p) do remember(surfaces, c, p)
      case "Texture" =>
        for p <- d.params do
          if p.name == "tex1" || p.name == "tex2" then
            constant(p).foreach(remember(surfaces, _, p))
          else if p.name == "filename" then mean(d, p).foreach(remember(surfaces, _, p))
      case "Medium" =>
        for
          a <- d.param("sigma_a")
          s <- d.param("sigma_s")
          (absorbed, scattered) <- constant(a).zip(constant(s))
        do addAlbedo(absorbed, scattered, s)
      case _ => ()

    /** pbrt-v4 has a spectrum for each coefficient. */
    private def addAlbedo(absorbed: Rgb, scattered: Rgb, p: Param): Unit =
      val (a, s) = (spectrum(absorbed, false), spectrum(scattered, false))
      val extinction = absorbed + scattered
      if extinction.r > 0f && extinction.g > 0f && extinction.b > 0f then
        val values = s.values.lazyZip(a.values).map((x, y) => x / (x + y))
        val color =
          Rgb(scattered.r / extinction.r, scattered.g / extinction.g, scattered.b / extinction.b)
        val _ = surfaces.getOrElseUpdate(color, LocatedColor(ColoredSpectrum(values, color), p.pos))

    private def remember(into: mutable.LinkedHashMap[Rgb, LocatedColor], c: Rgb, p: Param): Unit =
      // Scenes have thousands of colours
      val rounded = c.map(x => Math.round(x * 50) / 50f)
      if rounded.isFinite && !Values.isGray(rounded) && into.size < MaxColors then
        val _ = into.getOrElseUpdate(rounded, LocatedColor(spectrum(c, c.max <= 1f), p.pos))

  private val Reflecting = Set("reflectance", "transmittance", "color", "Kr", "Kt")
  private val MaxColors = 100
  private val White = ColoredSpectrum(ColorError.wavelengths.map(_ => 1.0), Rgb.White)

  /** In fractions of the brightest that components as large could be. */
  private def error(a: ColoredSpectrum, b: ColoredSpectrum): Double =
    val spectral = ColorError.srgb(a.values.lazyZip(b.values).map(_ * _))
    val color = a.components * b.components
    val deviation = color - Rgb(spectral(0).toFloat, spectral(1).toFloat, spectral(2).toFloat)
    deviation.largest / (a.components.max * b.components.max)

  /** As pbrt-v4: smooth, and if not a reflectance, half as bright as can be. */
  private def spectrum(c: Rgb, isBounded: Boolean): ColoredSpectrum =
    val scale = if isBounded then 1f else 2 * c.max
    val smooth = SmoothSpectra.spectrum(c * (1 / scale))
    ColoredSpectrum(ColorError.wavelengths.map(nm => (smooth(nm) * scale).toDouble), c)

  private def constant(p: Param): Option[Rgb] =
    Option.when(p.paramType == ParamType.Rgb && p.floats.length == 3):
      Rgb(p.floats(0), p.floats(1), p.floats(2))

  /** Mean colour of an image. */
  private def mean(d: Declaration, p: Param): Option[Rgb] =
    val file = d.folder.locate(p.strings.head, Some(p.valuesAt))
    file.flatMap(f => Try(ImageFiles.load(f).toImage.linear.toRgb).toOption).map: image =>
      val sums = new Array[Double](3)
      loop(image.data.length)(i => sums(i % 3) += image.data(i))
      val n = image.data.length / 3
      Rgb((sums(0) / n).toFloat, (sums(1) / n).toFloat, (sums(2) / n).toFloat)

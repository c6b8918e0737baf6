package candela.convert

import candela.base.loop
import candela.diagnostics.{Code, Problem, SourcePos}
import scala.collection.mutable
import scala.util.Try

import candela.color.{ColorError, ColoredSpectrum, Colorimetry, Rgb, SmoothSpectra, Spectrum}
import candela.color.Colorimetry.White
import candela.image.ImageFiles
import candela.io.SceneFolder
import candela.scenefile.{
  Declaration, Dialect, Param, ParamType, SceneDescription, TextureDescription
}

/** What becomes of colours where pbrt-v4 multiplies spectra and another program three numbers. It
  * considers one reflection off each surface, in the light of each emitter, and the albedos of
  * media; or two reflections, if one makes no visible difference. Images count by their mean.
  */
private[convert] object SpectralColors:

  /** Names the reflection whose colour differs most, if it does visibly.
    *
    * @param scene as pbrt-v4 has it
    * @param program the one that multiplies three numbers
    * @param visible the least difference that is reported, of the brightest channel
    */
  def warning(
      scene: SceneDescription,
      program: String,
      visible: Double = Visible
  ): Option[Problem] =
    val census = Census(scene)
    def problem(r: Reflection, event: String, where: Option[String]) =
      val percent = Math.round(r.error * 100)
      Problem.warning(
        Code.ShiftedColors,
        r.surface.pos,
        s"pbrt-v4 multiplies spectra, $program red, green and blue: $event differs by $percent % " +
          "of its brightest channel in pbrt-v4",
        where
      )
    def single =
      census.single.filter(_.error > visible).map: r =>
        problem(r, r.surface.event, Some(s"in the light of ${r.light.pos}").filter(_ => r.isPlaced))
    def double =
      census.double.filter(_.error > visible).map: r =>
        val isSame = r.light.pos == r.surface.pos
        val event =
          if isSame then "light reflected twice here" else "light reflected here and elsewhere"
        problem(r, event, Option.unless(isSame)(s"elsewhere: ${r.light.pos}"))
    single.orElse(double)

  /** Share of the brightest channel. */
  private val Visible = 0.005

  /** The same for scenes of pbrt, most of which are not meant to be exact. */
  val Plain = 0.02

  private final class LocatedColor(
      val color: ColoredSpectrum,
      val pos: SourcePos,
      val event: String = "light reflected here"
  )

  /** @param light or a surface that reflects it first */
  private final class Reflection(
      val error: Double,
      val surface: LocatedColor,
      val light: LocatedColor
  ):
    def isPlaced: Boolean = light.pos != SourcePos.Nowhere

  private final class Census(scene: SceneDescription):
    private val emitted, reflected = mutable.LinkedHashMap.empty[Rgb, LocatedColor]
    private val means = mutable.HashMap.empty[(SceneFolder, String), Option[Rgb]]
    private val values = Values(Dialect.V4, Dialect.V4, (_, _) => ())
    private val _ = Declarations.map(scene): d =>
      add(d)
      d
    scene.textures.filter(_.valueType == "spectrum").foreach(addTexture)

    private val surfaces = reflected.values.toVector
    private val lights =
      if emitted.isEmpty then Vector(LocatedColor(Even, SourcePos.Nowhere))
      else emitted.values.toVector

    def single: Option[Reflection] =
      val all =
        for surface <- surfaces.iterator; light <- lights
        yield Reflection(error(times(light.color, surface.color)), surface, light)
      all.maxByOption(_.error)

    def double: Option[Reflection] =
      val hasDepth = !scene.integrator.flatMap(_.param("maxdepth")).exists(_.ints.exists(_ < 2))
      val all =
        for
          light <- lights.iterator if hasDepth
          i <- surfaces.indices
          once = times(light.color, surfaces(i).color)
          other <- surfaces.take(i + 1)
        yield Reflection(error(times(once, other.color)), surfaces(i), other)
      all.maxByOption(_.error)

    private def add(d: Declaration): Unit = d.category match
      case "LightSource" | "AreaLightSource" => addLight(d)
      case "Material" =>
        for p <- d.params if Reflecting(p.name) do addSurface(p, d)
        for metal <- MetalColors.albedo(d) do remember(reflected, metal.components, d.pos)(metal)
      case "Medium" =>
        for
          a <- d.param("sigma_a")
          s <- d.param("sigma_s")
          (absorbed, scattered) <- constant(a).zip(constant(s))
        do addAlbedo(absorbed, scattered, s)
      case _ => ()

    private def addLight(d: Declaration): Unit =
      val stated = d.params.find(p => p.name == "L" || p.name == "I")
      val image = d.param("filename").filter(_ => stated.isEmpty)
      val color =
        stated.flatMap(emission(_, d))
          .orElse(image.flatMap(meanOf(d, _)).map(SpectralColors.spectrum(_, false)))
      val spectrum = color.getOrElse(Even)
      if spectrum.components.max > 0f then
        val pos = stated.orElse(image).fold(d.pos)(_.pos)
        remember(emitted, spectrum.components * (0.5f / spectrum.components.max), pos)(spectrum)

    /** Lights share images. */
    private def meanOf(d: Declaration, p: Param): Option[Rgb] =
      means.getOrElseUpdate((d.folder, p.strings.head), mean(d, p))

    private def addTexture(t: TextureDescription): Unit =
      val d = t.texture
      for p <- d.params do
        if TextureColors(p.name) then addSurface(p, d)
        else if p.name == "filename" && reflected.size < MaxColors then
          for c <- meanOf(d, p) do addSurface(c, p, "the mean of light reflected here")

    private def addSurface(p: Param, d: Declaration): Unit = p.paramType match
      case ParamType.Spectrum =>
        for s <- values.spectrum(p, d) do
          val color = Colorimetry.rgb(s, White.D65)
          val exact = ColoredSpectrum(ColorError.wavelengths.map(s(_).toDouble), color)
          remember(reflected, color, p.pos)(exact)
      case _ => constant(p).foreach(addSurface(_, p, "light reflected here"))

    private def addSurface(c: Rgb, p: Param, event: String): Unit =
      if !Values.isGray(rounded(c)) then
        remember(reflected, c, p.pos, event)(spectrum(c, c.max <= 1f))

    /** pbrt-v4 has a spectrum for each coefficient. */
    private def addAlbedo(absorbed: Rgb, scattered: Rgb, p: Param): Unit =
      val (a, s) = (spectrum(absorbed, false), spectrum(scattered, false))
      val extinction = absorbed + scattered
      if extinction.r > 0f && extinction.g > 0f && extinction.b > 0f then
        val values = s.values.lazyZip(a.values).map((x, y) => x / (x + y))
        val color =
          Rgb(scattered.r / extinction.r, scattered.g / extinction.g, scattered.b / extinction.b)
        remember(reflected, color, p.pos, "light scattered here")(ColoredSpectrum(values, color))

    private def emission(p: Param, d: Declaration): Option[ColoredSpectrum] = p.paramType match
      case ParamType.Blackbody => p.floats.headOption.map(t => light(Spectrum.blackbody(t)))
      case ParamType.Spectrum => values.spectrum(p, d).map(light)
      case _ => constant(p).map(spectrum(_, false))

    // Scenes have thousands of colours
    private def remember(
        into: mutable.LinkedHashMap[Rgb, LocatedColor],
        c: Rgb,
        pos: SourcePos,
        event: String = "light reflected here"
    )(color: => ColoredSpectrum): Unit =
      if c.isFinite && into.size < MaxColors then
        val _ = into.getOrElseUpdate(rounded(c), LocatedColor(color, pos, event))

  private val Reflecting = Set("reflectance", "transmittance", "color", "Kr", "Kt")
  private val TextureColors =
    Set("tex1", "tex2", "value", "inside", "outside", "v00", "v01", "v10", "v11")
  private val MaxColors = 100
  private val Even = ColoredSpectrum(ColorError.wavelengths.map(_ => 1.0), Rgb.White)

  private def rounded(c: Rgb): Rgb = c.map(x => Math.round(x * 50) / 50f)

  private def times(a: ColoredSpectrum, b: ColoredSpectrum): ColoredSpectrum =
    ColoredSpectrum(a.values.lazyZip(b.values).map(_ * _), a.components * b.components)

  /** Largest difference of a channel, in fractions of the brightest one of the spectrum. */
  private def error(product: ColoredSpectrum): Double =
    val exact = ColorError.srgb(product.values)
    val color = Rgb(exact(0).toFloat, exact(1).toFloat, exact(2).toFloat)
    if color.max > 0f then (product.components - color).largest / color.max else 0.0

  /** As pbrt-v4: smooth, and if not a reflectance, half as bright as can be. */
  def spectrum(c: Rgb, isBounded: Boolean): ColoredSpectrum =
    if Values.isGray(c) then ColoredSpectrum(Even.values.map(_ * c.r), c)
    else
      val scale = if isBounded then 1f else 2 * c.max
      val smooth = SmoothSpectra.spectrum(c * (1 / scale))
      ColoredSpectrum(ColorError.wavelengths.map(nm => (smooth(nm) * scale).toDouble), c)

  /** Light of luminance 1. */
  private def light(s: Spectrum): ColoredSpectrum =
    val relative = ColorError.wavelengths.map(nm => (s(nm) / Colorimetry.D65(nm)).toDouble)
    val scale = 1 / ColorError.luminance(relative)
    ColoredSpectrum(relative.map(_ * scale), Colorimetry.unitLuminance(s).map(Math.max(_, 0f)))

  private def constant(p: Param): Option[Rgb] =
    Option.when(p.paramType == ParamType.Rgb && p.floats.length == 3):
      Rgb(p.floats(0), p.floats(1), p.floats(2))

  /** Mean colour of an image. */
  private def mean(d: Declaration, p: Param): Option[Rgb] =
    val file = d.folder.locate(p.strings.head, Some(p.valuesAt))
    file.flatMap(f => Try(ImageFiles.load(f).toRgb).toOption).map: image =>
      val sums = new Array[Double](3)
      loop(image.data.length)(i => sums(i % 3) += image.data(i))
      val n = image.data.length / 3
      Rgb((sums(0) / n).toFloat, (sums(1) / n).toFloat, (sums(2) / n).toFloat)

package candela.build.film

import candela.diagnostics.{Code, Suggest}
import candela.aov.{HitValue, Layer, NamedLayer}
import candela.build.recipe.*
import candela.color.{CameraSensor, WhiteBalance}
import candela.scenefile.Dialect
import candela.film.{Development, SampleLimit, SpectralBands}
import candela.image.{Exposure, PixelFormat}

object ImageFilmRecipe extends FilmRecipe("image", "RGB image", untilV3):
  private val scale =
    float("scale", "scale of all pixel values", onlyV3, range = FilmRecipe.Gain)(1f)
  private val maxLuminance =
    float(
      "maxsampleluminance",
      "maximum luminance of a sample; brighter ones are scaled down",
      onlyV3,
      range = Range.endless
    )(Float.PositiveInfinity)
  noMeaning("no external program displays the image")(
    bool("display", "display the image during rendering", onlyV2)(false)
  )
  protected def create()(using Site): FilmSettings =
    settings(
      Development(scale(), clipsNegative = true),
      _ => SampleLimit.luminance(maxLuminance())
    )

object RgbFilmRecipe extends SensorFilmRecipe("rgb", "RGB image"):
  private val alpha = bool("alpha", "add the layer alpha, channel A", onlyMitsuba)(false)
  private val border = bool(
    "sampleborder",
    "sample beyond the film, too, as far as the filter reaches",
    onlyMitsuba
  )(true)
  private val named = strings(
    "aovs",
    "string[]",
    "layers of the first surface, each a name and a quantity: `a:depth` is the channel `a.T`, " +
      "`a:field_depth` is `a.Y`",
    onlyMitsuba
  )
  private val format = oneOf(
    "pixelformat",
    "channels of image files",
    PixelFormat.values.map(_.word).toVector,
    onlyMitsuba
  )(PixelFormat.Colors.word)
  private val exposure =
    float("exposure", "scale of the light in pictures", onlyMitsuba, unit = "stops")(0f)

  /** Files have linear light; what pictures show is asked of options. */
  private def warnOfExposure()(using site: Site): Unit =
    val stops = exposure()
    if site.resources.settings.output.display.exposure != Exposure.Stops(stops) then
      for p <- site.declaration.param("exposure") do
        site.problems.warn(
          Code.Unsupported,
          p.pos,
          "`exposure` is not supported; the image has linear values",
          Some(s"--exposure ${DefaultText.number(stops)} shows it in pictures, such as .png files")
        )

  override protected def create()(using Site): FilmSettings =
    warnOfExposure()
    val layers = Option.when(alpha())(Layer.Alpha) ++
      named().flatMap: text =>
        val (name, word) = (text.take(text.lastIndexOf(':')), text.drop(text.lastIndexOf(':') + 1))
        HitValue.values.find(v => word == v.word || word == s"field_${v.word}").map: value =>
          NamedLayer(name, value, inColors = word != value.word)
    val base = super.create()
    val channels = PixelFormat.values.find(_.word == format()).getOrElse(PixelFormat.Colors)
    base.copy(
      development = base.development.copy(format = channels),
      layers = layers.toVector,
      samplesBorder = border()
    )

object GBufferFilmRecipe
    extends SensorFilmRecipe("gbuffer", "RGB image with AOVs: positions, normals, albedo and more"):
  private val space = oneOf(
    "coordinatesystem",
    "space of positions and normals",
    Vector("camera", "world")
  )("camera")
  override protected def create()(using Site): FilmSettings =
    super.create().copy(layers = Layer.gbuffer, layersInWorld = space() == "world")

object SpectralFilmRecipe
    extends SensorFilmRecipe("spectral", "spectral image in bands of wavelengths"):
  private val buckets =
    integer("nbuckets", "number of spectral bands", range = Range(1f, 1000f))(16)
  private val Visible = Range(360f, 830f)
  private val shortest =
    float("lambdamin", "shortest wavelength", unit = "nm", range = Visible)(360f)
  private val longest = float("lambdamax", "longest wavelength", unit = "nm", range = Visible)(830f)

  override protected def create()(using site: Site): FilmSettings =
    val (from, to) = (shortest(), longest())
    if !(from < to) then
      site.error(Code.ParameterValue, s"`lambdamin`, $from nm, must be below `lambdamax`, $to nm")
    site.resources.counting.foreach(_.addBands(buckets()))
    if !site.resources.mayBeSpectral then
      site.warn(
        Code.Unsupported,
        "rendering is RGB, not spectral; bands sample a smooth spectrum fitted to each pixel's " +
          "colour"
      )
    val base = super.create()
    val bands = SpectralBands(buckets(), from, to)
    base.copy(development = base.development.copy(bands = Some(bands)))

/** Base of v4's films, with a sensor model. */
abstract class SensorFilmRecipe(name: String, meaning: String)
    extends FilmRecipe(name, meaning, onlyV4):
  private val iso = float("iso", "sensor sensitivity; 100: unscaled", range = FilmRecipe.Gain)(100f)
  private val sensor =
    string("sensor", "sensor response: cie1931, or the name of a camera")("cie1931")
  private val maxComponent =
    float(
      "maxcomponentvalue",
      "maximum of a sample's sensor values, X, Y and Z for cie1931, after `iso` and exposure and " +
        "before white balance; larger ones are scaled down",
      range = Range.endless
    )(Float.PositiveInfinity)
  private val white =
    float(
      "whitebalance",
      "colour temperature of white; none: no white balance, but 6500 for cameras",
      unit = "K",
      shown = "none",
      // Below, the white point has next to no green and blue
      range = Range.atLeast(1000f).including(0f)
    )(0f)
  private val halfPrecision = bool("savefp16", "write 16-bit instead of 32-bit values")(true)

  protected def create()(using site: Site): FilmSettings =
    val development =
      Development(
        iso() / 100f,
        clipsNegative = false,
        isHalf = halfPrecision(),
        space = site.colorSpace
      )
    val kelvin = white()
    if maxComponent().isFinite && site.rules.dialect == Dialect.V4 then
      site.warn(
        Code.UnlikePbrt,
        "pbrt-v4 applies `maxcomponentvalue` to samples of few random wavelengths, whose colours " +
          "are noisy; what is brighter than half the limit may be darker in its image"
      )
    camera() match
      case Some(cameraSensor) =>
        val balanced = if kelvin == 0f then SensorFilmRecipe.White else kelvin
        settings(
          development.copy(
            sensor = Some(cameraSensor.response),
            balance = Some(cameraSensor.toRgb(balanced, site.colorSpace))
          ),
          exposure =>
            SampleLimit.camera(largest(exposure), cameraSensor.toRgb(SensorFilmRecipe.White))
        ).copy(camera = Some(cameraSensor))
      case None =>
        val space = site.colorSpace
        val balance =
          if kelvin > 0f then Some(WhiteBalance.ofDaylight(kelvin, space))
          else Option.when(!space.isSrgb)(space.ofSrgb.toFloats)
        settings(
          development.copy(balance = balance),
          exposure => SampleLimit.sensor(largest(exposure))
        )

  private def largest(exposure: Float)(using Site): Float =
    maxComponent() / (iso() / 100f * exposure)

  /** Returns the camera sensor, or None for the CIE 1931 observer. */
  private def camera()(using site: Site): Option[CameraSensor] =
    val name = sensor()
    val cameraSensor = CameraSensor.named(name)
    if cameraSensor.isDefined then
      site.resources.counting.foreach(_.addDetector(s"the sensor \"$name\" responds to spectra"))
      if !site.resources.mayBeSpectral then
        site.warn(
          Code.Unsupported,
          s"rendering is RGB, not spectral; sensor \"$name\" responds to a smooth spectrum " +
            "fitted to each pixel's colour"
        )
    else if name != "cie1931" then
      site.missing(
        Code.UnknownType,
        s"unknown sensor \"$name\"",
        "using \"cie1931\"",
        Suggest.help(name, "cie1931" +: CameraSensor.names)
      )
    cameraSensor

private object SensorFilmRecipe:
  /** Default white balance of cameras, in K. */
  val White = 6500f

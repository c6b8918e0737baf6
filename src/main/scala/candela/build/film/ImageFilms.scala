package candela.build.film

import candela.base.Suggest
import candela.build.recipe.*
import candela.color.{CameraSensor, WhiteBalance}
import candela.film.{Development, Layer, SampleLimit, SpectralBands}

object ImageFilmRecipe extends FilmRecipe("image", "an image of red, green and blue", untilV3):
  private val scale = float("scale", "factor of all pixel values", onlyV3)(1f)
  private val most =
    float("maxsampleluminance", "brighter samples are scaled down", onlyV3)(Float.PositiveInfinity)
  noMeaning("no other program shows the image")(
    bool("display", "show the image while it is rendered", onlyV2)(false)
  )
  protected def make()(using Site): FilmSettings =
    settings(
      Development(scale(), clipsNegative = true),
      _ => SampleLimit.luminance(most())
    )

object RgbFilmRecipe extends SensorFilmRecipe("rgb", "an image of red, green and blue")

object GBufferFilmRecipe
    extends SensorFilmRecipe("gbuffer", "an image with positions, normals, albedo and more"):
  private val space = oneOf(
    "coordinatesystem",
    "of positions and normals",
    Vector("camera", "world")
  )("camera")
  override protected def make()(using Site): FilmSettings =
    super.make().copy(layers = Layer.gbuffer, layersInWorld = space() == "world")

object SpectralFilmRecipe extends SensorFilmRecipe("spectral", "an image of many wavelengths"):
  private val buckets = integer("nbuckets", "bands of wavelengths")(16)
  private val shortest = float("lambdamin", "shortest wavelength", unit = "nm")(360f)
  private val longest = float("lambdamax", "longest wavelength", unit = "nm")(830f)

  override protected def make()(using site: Site): FilmSettings =
    val (from, to) = (shortest(), longest())
    if buckets() < 1 then site.error(s"`nbuckets` is 1 or more; found ${buckets()}")
    if !(from >= 360f && from < to && to <= 830f) then
      site.error(s"`lambdamin` and `lambdamax` lie between 360 and 830 nm; found $from and $to")
    site.warn(
      "light has three components here, no wavelengths: bands are those of a smooth spectrum of " +
        "each pixel's colour"
    )
    val made = super.make()
    val bands = SpectralBands(Math.max(buckets(), 1), from, to)
    made.copy(development = made.development.copy(bands = Some(bands)))

/** v4's films: what a sensor makes of the light. */
abstract class SensorFilmRecipe(name: String, meaning: String)
    extends FilmRecipe(name, meaning, onlyV4):
  private val iso = float("iso", "sensitivity; 100 leaves values as they are")(100f)
  private val sensor =
    string("sensor", "whose colour response: cie1931, or a camera's name")("cie1931")
  private val most =
    float("maxcomponentvalue", "samples with a larger X, Y or Z are scaled down")(
      Float.PositiveInfinity
    )
  private val white =
    float(
      "whitebalance",
      "colour temperature that becomes white; none: colours stay, but cameras take 6500",
      unit = "K",
      shown = "none"
    )(0f)
  private val half = bool("savefp16", "16 bits a value, not 32")(true)

  protected def make()(using site: Site): FilmSettings =
    if white() < 0f then site.error(s"`whitebalance` is a temperature in K; found ${white()}")
    val development = Development(iso() / 100f, clipsNegative = false, isHalf = half())
    val kelvin = Math.max(white(), 0f)
    camera() match
      case Some(found) =>
        val balanced = if kelvin == 0f then SensorFilmRecipe.White else kelvin
        settings(
          development.copy(
            sensor = Some(found.response),
            balance = Some(found.toSrgb(balanced))
          ),
          exposure => SampleLimit.camera(largest(exposure), found.toSrgb(SensorFilmRecipe.White))
        )
      case None =>
        val balance = Option.when(kelvin > 0f)(WhiteBalance.ofDaylight(kelvin))
        settings(
          development.copy(balance = balance),
          exposure => SampleLimit.sensor(largest(exposure))
        )

  private def largest(exposure: Float)(using Site): Float = most() / (iso() / 100f * exposure)

  /** The sensor, if it is not the standard observer. */
  private def camera()(using site: Site): Option[CameraSensor] =
    val name = sensor()
    val found = CameraSensor.named(name)
    if found.isDefined then
      site.warn(
        s"light has three components here, no wavelengths: sensor \"$name\" sees a smooth " +
          "spectrum of each pixel's colour"
      )
    else if name != "cie1931" then
      site.missing(
        s"no sensor is named `$name`",
        "the CIE 1931 observer is used",
        Suggest.help(name, "cie1931" +: CameraSensor.names)
      )
    found

private object SensorFilmRecipe:
  /** To which cameras are balanced if nothing is said, in K. */
  val White = 6500f

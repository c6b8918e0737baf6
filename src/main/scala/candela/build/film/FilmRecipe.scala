package candela.build

import candela.base.Suggest
import candela.color.WhiteBalance
import candela.film.{Development, SampleLimit}
import candela.scenefile.Dialect

/** What all films have. */
abstract class FilmRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[FilmSettings](name, meaning, dialects):
  private val x =
    integer("xresolution", "image width", unit = "pixels")(if v2 then 640 else 1280)
  private val y =
    integer("yresolution", "image height", unit = "pixels")(if v2 then 480 else 720)
  private val crop =
    numbers("cropwindow", "float[4]", "x0 x1 y0 y1: the part to render, 0 to 1", shown = "all")
  private val pixels =
    integers(
      "pixelbounds", "x0 x1 y0 y1: the part to render, in pixels", onlyV4, "integer[4]", "all"
    )
  private val file =
    string("filename", "image to write; its ending chooses the format")("pbrt.exr")
  private val diagonal =
    float("diagonal", "of the film; only realistic cameras ask for it", sinceV3, unit = "mm")(35f)

  protected def settings(development: Development, limit: Float => Option[SampleLimit])(using
      site: Site
  ): FilmSettings =
    val (w, h) = (x(), y())
    if w < 1 || h < 1 || w.toLong * h > Int.MaxValue / 16 then
      site.error(s"an image of $w×$h pixels can't be rendered")
    // Of two windows v4 takes the one in parts of the image
    val inPixels = crop().isEmpty && pixels().length == 4
    val window = if inPixels then pixels().map(_.toFloat) else crop()
    if window.length != 0 && window.length != 4 then site.error("`cropwindow` takes x0 x1 y0 y1")
    if !(diagonal() > 0f) then site.error(s"`diagonal` is above 0 mm; found ${diagonal()}")
    FilmSettings(
      Math.max(w, 1),
      Math.max(h, 1),
      if window.length == 4 then ordered(window) else Array(0f, 1f, 0f, 1f),
      inPixels,
      file(),
      development,
      limit,
      diagonal() / 1000f
    )

  /** Its edges may come in any order. */
  private def ordered(w: Array[Float]): Array[Float] =
    Array(w(0).min(w(1)), w(0).max(w(1)), w(2).min(w(3)), w(2).max(w(3)))

/** v4's films: what a sensor makes of the light. */
abstract class SensorFilm(name: String, meaning: String) extends FilmRecipe(name, meaning, onlyV4):
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
    val kelvin = if white() == 0f && sensor() != "cie1931" then 6500f else white()
    if kelvin < 0f then site.error(s"`whitebalance` is a temperature in K; found $kelvin")
    checkSensor()
    val scale = iso() / 100f
    val balance = Option.when(kelvin > 0f)(WhiteBalance.ofDaylight(kelvin))
    settings(
      Development(scale, balance, clipsNegative = false, isHalf = half()),
      exposure => SampleLimit.sensor(most() / (scale * exposure))
    )

  /** A camera's response to three components of colour is that of the standard observer, but for
    * what pbrt's fit of a matrix to 24 colours leaves.
    */
  private def checkSensor()(using site: Site): Unit =
    val name = sensor()
    if SensorNames.all.contains(name) then
      site.warn(
        s"colours are rendered as red, green and blue, not by wavelength: sensor \"$name\" sees " +
          "them as the CIE 1931 observer does"
      )
    else if name != "cie1931" then
      site.missing(
        s"no sensor is named `$name`",
        "the CIE 1931 observer is used",
        Suggest.help(name, "cie1931" +: SensorNames.all)
      )

/** Cameras whose response pbrt-v4 has measured. */
private object SensorNames:
  val all: Vector[String] = Vector(
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d", "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii", "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds", "canon_eos_m",
    "hasselblad_l1d_20c", "nikon_d810", "nikon_d850", "sony_ilce_6400", "sony_ilce_7m3",
    "sony_ilce_7rm3", "sony_ilce_9"
  )

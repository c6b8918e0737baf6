package candela.build

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
  noMeaning("only realistic lenses ask for it, which are not supported yet")(
    float("diagonal", "of the film", sinceV3, unit = "mm")(35f)
  )

  /** @param brightest to which samples are scaled down */
  protected def settings(scale: Float, brightest: Float)(using site: Site): FilmSettings =
    val (w, h) = (x(), y())
    if w < 1 || h < 1 || w.toLong * h > Int.MaxValue / 16 then
      site.error(s"an image of $w×$h pixels can't be rendered")
    // Of two windows v4 takes the one in parts of the image
    val inPixels = crop().isEmpty && pixels().length == 4
    val window = if inPixels then pixels().map(_.toFloat) else crop()
    if window.length != 0 && window.length != 4 then site.error("`cropwindow` takes x0 x1 y0 y1")
    FilmSettings(
      Math.max(w, 1),
      Math.max(h, 1),
      if window.length == 4 then window else Array(0f, 1f, 0f, 1f),
      inPixels,
      file(),
      scale,
      brightest
    )

/** v4's films: what a sensor makes of the light. */
abstract class SensorFilm(name: String, meaning: String) extends FilmRecipe(name, meaning, onlyV4):
  private val iso = float("iso", "sensitivity; 100 leaves values as they are")(100f)
  private val sensor =
    string("sensor", "whose colour response: cie1931, or a camera's name")("cie1931")
  private val most =
    float("maxcomponentvalue", "samples with a brighter component are scaled down")(
      Float.PositiveInfinity
    )
  notYet("colours are not balanced")(
    float("whitebalance", "colour temperature that becomes white", unit = "K", shown = "none")(0f)
  )
  noMeaning("files have 16 bits a value")(bool("savefp16", "16 bits a value, not 32")(true))

  protected def make()(using site: Site): FilmSettings =
    if sensor() != "cie1931" then
      site.warn(s"sensor `${sensor()}` is not supported yet; the CIE 1931 observer is used")
    val scale = iso() / 100f
    settings(scale, most() / scale)

package candela.build

import candela.scenefile.Dialect

/** Recipes of the film. */
object Films:
  val all: Recipes[FilmSettings] = Recipes(
    "film",
    Vector(
      ImageFilm("image", "an image of red, green and blue", untilV3),
      ImageFilm("rgb", "an image of red, green and blue", onlyV4),
      ImageFilm("gbuffer", "an image with positions, normals and more", onlyV4),
      ImageFilm("spectral", "an image of many wavelengths", onlyV4)
    )
  )

/** What a Film statement says.
  *
  * @param crop         x0, x1, y0, y1 as parts of the full image, or pixels if `inPixels`
  * @param scale        factor of all pixel values
  */
final case class FilmSettings(
    width: Int,
    height: Int,
    crop: Array[Float],
    inPixels: Boolean,
    filename: String,
    scale: Float,
    maxComponent: Float
)

final class ImageFilm(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[FilmSettings](name, meaning, dialects):
  private val x = integer("xresolution", "image width in pixels")(if v2 then 640 else 1280)
  private val y = integer("yresolution", "image height in pixels")(if v2 then 480 else 720)
  private val crop = numbers("cropwindow", "float[4]", "x0 x1 y0 y1: the part to render, 0 to 1")
  private val pixels = integers("pixelbounds", "x0 x1 y0 y1: the part to render, in pixels")
  private val file =
    string("filename", "image to write; its ending chooses the format")("pbrt.exr")
  private val scale = float("scale", "factor of all pixel values", untilV3)(1f)
  private val iso =
    float("iso", "sensor sensitivity; 100 leaves values as they are", onlyV4)(100f)
  private val exposure = float("exposuretime", "seconds", onlyV4)(1f)
  private val sensor = string("sensor", "colour response of the sensor", onlyV4)("cie1931")
  private val maxLuminance =
    float("maxsampleluminance", "brighter samples are scaled down", onlyV3)(
      Float.PositiveInfinity
    )
  private val maxComponent =
    float("maxcomponentvalue", "brighter samples are scaled down", onlyV4)(
      Float.PositiveInfinity
    )
  noMeaning("no lens is made of glass yet")(
    float("diagonal", "of the film", sinceV3, unit = "mm")(35f)
  )
  noMeaning("no other program shows the image")(
    bool("display", "show the image while it is rendered", onlyV2)(false)
  )
  noMeaning("files have 16-bit floats")(bool("savefp16", "16 bits a value, not 32", onlyV4)(true))
  if name == "gbuffer" then
    noMeaning("only colours are written")(
      string("coordinatesystem", "of positions and normals: camera, world", onlyV4)("camera")
    )

  protected def make()(using site: Site): FilmSettings =
    if name == "gbuffer" || name == "spectral" then
      site.warn(s"film \"$name\": only the colour channels R, G, B are written")
    if sensor() != "cie1931" then
      site.warn(s"sensor `${sensor()}` is not supported yet; the CIE 1931 observer is used")
    val (w, h) = (x(), y())
    if w < 1 || h < 1 || w.toLong * h > Int.MaxValue / 16 then
      site.error(s"an image of $w×$h pixels can't be rendered")
    val byPixels = pixels().length == 4
    val window = if byPixels then pixels().map(_.toFloat) else crop()
    if window.length != 0 && window.length != 4 then site.error("`cropwindow` takes x0 x1 y0 y1")
    FilmSettings(
      Math.max(w, 1),
      Math.max(h, 1),
      if window.length == 4 then window else Array(0f, 1f, 0f, 1f),
      byPixels,
      file(),
      scale() * iso() / 100f * exposure(),
      Math.min(maxLuminance(), maxComponent())
    )

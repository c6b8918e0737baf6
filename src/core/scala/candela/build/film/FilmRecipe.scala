package candela.build.film

import candela.diagnostics.Code
import candela.aov.ImageLayer
import candela.build.recipe.*
import candela.color.CameraSensor
import candela.film.{Development, SampleLimit}
import candela.scenefile.Dialect

/** Recipes of films. */
object Films:
  val all: Recipes[FilmSettings] =
    Recipes("film", Vector(ImageFilmRecipe, RgbFilmRecipe, GBufferFilmRecipe, SpectralFilmRecipe))

/** Settings of a Film statement.
  *
  * @param crop         x0, x1, y0, y1 as fractions of the full image, or pixels if `inPixels`
  * @param development  conversion of pixel values, except for v4's shutter time
  * @param limit        limit of sample values, given v4's factor on samples
  * @param diagonal     diagonal of the film, in metres
  * @param layers       requested AOVs
  * @param layersInWorld whether AOVs are in world space, instead of camera space
  * @param camera       the sensor, unless it is the standard observer
  * @param samplesBorder whether samples beyond the crop window contribute to its pixels
  */
final case class FilmSettings(
    width: Int,
    height: Int,
    crop: Array[Float],
    inPixels: Boolean,
    filename: String,
    development: Development,
    limit: Float => Option[SampleLimit],
    diagonal: Float,
    layers: Vector[ImageLayer] = Vector.empty,
    layersInWorld: Boolean = false,
    camera: Option[CameraSensor] = None,
    samplesBorder: Boolean = true
):
  /** Of spectral rendering, whose samples are the sensor's own responses. */
  def spectral(exposure: Float): FilmSettings = camera.fold(this): _ =>
    copy(
      development = development.copy(sensor = None),
      limit = _ => limit(exposure).flatMap(l => SampleLimit.channels(l.maximum))
    )

/** Base of film recipes. */
abstract class FilmRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[FilmSettings](name, meaning, dialects):
  private val x =
    integer("xresolution", "image width", unit = "pixels", range = FilmRecipe.Across)(if v2 then 640
    else 1280)
  private val y =
    integer("yresolution", "image height", unit = "pixels", range = FilmRecipe.Across)(if v2 then
      480
    else 720)
  private val crop =
    numbers(
      "cropwindow",
      "float[4]",
      "x0 x1 y0 y1: crop window as fractions of the image, 0 to 1",
      shown = "all"
    )
  private val pixels =
    integers(
      "pixelbounds", "x0 x1 y0 y1: crop window in pixels", onlyV4, "integer[4]", "all"
    )
  private val file =
    string(
      "filename",
      "image file; its extension selects the format; by default, it has the scene's name"
    )(FilmRecipe.DefaultFile)
  private val diagonal =
    float(
      "diagonal",
      "diagonal of the film, for realistic cameras",
      sinceV3,
      unit = "mm",
      range = Range.above(0f)
    )(35f)

  protected def settings(development: Development, limit: Float => Option[SampleLimit])(using
      site: Site
  ): FilmSettings =
    // v4 prefers the fractional window if both are given
    val inPixels = crop().isEmpty && pixels().length == 4
    val edges = if inPixels then pixels().map(_.toFloat) else crop()
    val isWindow = edges.length == 4
    if edges.nonEmpty && !isWindow then
      val message = s"`cropwindow` must be x0 x1 y0 y1, found ${edges.length} numbers"
      site.warn(Code.CorrectedValue, s"$message; it is ignored, as pbrt does")
    val window = if isWindow then edges else Array.emptyFloatArray
    FilmSettings(
      x(),
      y(),
      if window.length == 4 then ordered(window) else Array(0f, 1f, 0f, 1f),
      inPixels,
      file(),
      development,
      limit,
      diagonal() / 1000f
    )

  /** Sorts the edges of a window. */
  private def ordered(w: Array[Float]): Array[Float] =
    Array(w(0).min(w(1)), w(0).max(w(1)), w(2).min(w(3)), w(2).max(w(3)))

object FilmRecipe:
  /** The image file of scenes that name none. */
  val DefaultFile = "pbrt.exr"

  /** Of pixels; what is larger or smaller has products that overflow or vanish. */
  val Gain: Range = Range(1e-10f, 1e10f)

  /** Pixels: as far as Floats count all of them. How many may be rendered at once is asked of the
    * crop window.
    */
  private val Across = Range(1f, 1 << 24)

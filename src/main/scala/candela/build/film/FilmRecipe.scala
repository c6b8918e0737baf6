package candela.build.film

import candela.build.recipe.*
import candela.film.{Development, Layer, SampleLimit}
import candela.scenefile.Dialect

/** Recipes of the film. */
object Films:
  val all: Recipes[FilmSettings] =
    Recipes("film", Vector(ImageFilmRecipe, RgbFilmRecipe, GBufferFilmRecipe, SpectralFilmRecipe))

/** What a Film statement says.
  *
  * @param crop         x0, x1, y0, y1 as parts of the full image, or pixels if `inPixels`
  * @param development  how pixel values are made, but for the time that v4's shutter is open
  * @param limit        of samples, for a factor by which v4 multiplies them first
  * @param diagonal     of the film, in metres
  * @param layers       what the image holds beside colours
  * @param layersInWorld are they in world space, not in the camera's?
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
    layers: Vector[Layer] = Vector.empty,
    layersInWorld: Boolean = false
)

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

package candela.build

import candela.film.*
import candela.scenefile.Dialect

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

/** Recipes of the film. */
object Films:
  val all: Recipes[FilmSettings] =
    Recipes("film", Vector("image", "rgb", "gbuffer", "spectral").map(ImageFilm(_)))

  final class ImageFilm(name: String) extends Recipe[FilmSettings](name):
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
    irrelevant("diagonal", "display", "savefp16")
    if name == "gbuffer" then irrelevant("coordinatesystem")

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

/** Recipes of reconstruction filters. */
object Filters:
  val all: Recipes[Filter] =
    Recipes("pixel filter", Vector(Box, Triangle, Gaussian, Mitchell, Sinc))

  abstract class FilterRecipe(name: String) extends Recipe[Filter](name):
    /** v2 and v3 say `xwidth`, v4 says `xradius`; both mean the half extent. */
    protected def extents(default: Dialect ?=> Float): Seq[(Field[Float], Field[Float])] =
      Seq("x", "y").map: axis =>
        (
          float(s"${axis}width", s"half extent along $axis, pixels")(default),
          float(s"${axis}radius", s"half extent along $axis, pixels")(default)
        )

    protected def radii(fields: Seq[(Field[Float], Field[Float])])(using Site): (Float, Float) =
      val Seq(x, y) = fields.map((width, radius) =>
        Math.max(1e-3f, radius.given_().orElse(width.given_()).getOrElse(radius()))
      ): @unchecked
      (x, y)

  object Box extends FilterRecipe("box"):
    private val size = extents(0.5f)
    protected def make()(using Site): Filter =
      val (x, y) = radii(size)
      BoxFilter(x, y)

  object Triangle extends FilterRecipe("triangle"):
    private val size = extents(2f)
    protected def make()(using Site): Filter =
      val (x, y) = radii(size)
      TriangleFilter(x, y)

  object Gaussian extends FilterRecipe("gaussian"):
    private val size = extents(if v4 then 1.5f else 2f)
    private val alpha = float("alpha", "falloff: exp(-alpha d²)", untilV3)(2f)
    private val sigma = float("sigma", "standard deviation, pixels", onlyV4)(0.5f)
    protected def make()(using site: Site): Filter =
      val (x, y) = radii(size)
      if site.dialect == Dialect.V4 then GaussianFilter.ofSigma(x, y, sigma())
      else GaussianFilter.ofAlpha(x, y, alpha())

  object Mitchell extends FilterRecipe("mitchell"):
    private val size = extents(2f)
    private val b = float("B", "blur")(1f / 3f)
    private val c = float("C", "ringing")(1f / 3f)
    protected def make()(using Site): Filter =
      val (x, y) = radii(size)
      MitchellFilter(x, y, b(), c())

  object Sinc extends FilterRecipe("sinc"):
    private val size = extents(4f)
    private val tau = float("tau", "cycles before the window ends")(3f)
    protected def make()(using site: Site): Filter =
      val (x, y) = radii(size)
      if site.dialect == Dialect.V2 then LanczosSincFilter.stretched(x, y, tau())
      else LanczosSincFilter(x, y, tau())

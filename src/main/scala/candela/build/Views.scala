package candela.build

import candela.cameras.{Camera, OrthographicCamera, PerspectiveCamera, ProjectiveSetup}
import candela.film.*
import candela.math.*
import candela.sampling.*
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
    private val file = string("filename", "image to write; its ending chooses the format")("pbrt.exr")
    private val scale = float("scale", "factor of all pixel values", untilV3)(1f)
    private val iso = float("iso", "sensor sensitivity; 100 leaves values as they are", onlyV4)(100f)
    private val exposure = float("exposuretime", "seconds", onlyV4)(1f)
    private val sensor = string("sensor", "colour response of the sensor", onlyV4)("cie1931")
    private val maxLuminance = float("maxsampleluminance", "brighter samples are scaled down", onlyV3)(
      Float.PositiveInfinity
    )
    private val maxComponent = float("maxcomponentvalue", "brighter samples are scaled down", onlyV4)(
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

/** What a sampler is made for. */
final case class SamplerRequest(spp: Option[Int], seed: Int, width: Int, height: Int)

/** Recipes of samplers. */
object Samplers:
  private val sobolNames = Vector(
    "lowdiscrepancy", "02sequence", "sobol", "paddedsobol", "bestcandidate", "pmj02bn",
    "maxmindist", "adaptive"
  )

  val all: Recipes[SamplerRequest => Sampler] = Recipes(
    "sampler",
    Vector("independent", "random").map(Independent(_)) ++ sobolNames.map(Sobol(_)) ++
      Vector(ZSobol, Halton, Stratified)
  )

  abstract class SamplerRecipe(name: String, default: Int = 16)
      extends Recipe[SamplerRequest => Sampler](name):
    private val samples =
      integer("pixelsamples", "samples per pixel")(if v2 then 4 else default)
    irrelevant("randomization", "dimensions", "samplepixelcenter")
    protected val seed = integer("seed", "of the random numbers", onlyV4)(0)

    protected def count(request: SamplerRequest)(using site: Site): Int =
      request.spp.getOrElse:
        val n = samples()
        if n < 1 then site.error(s"`pixelsamples` must be at least 1; found $n")
        Math.max(1, n)

  final class Independent(name: String) extends SamplerRecipe(name, default = 4):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => IndependentSampler(count(request), request.seed ^ s)

  /** Scrambled (0,2)-sequences, under the many names of such samplers. */
  final class Sobol(name: String) extends SamplerRecipe(name):
    private val most = integer("maxsamples", "samples per pixel of \"adaptive\"")(32)
    irrelevant("minsamples", "method")
    protected def make()(using site: Site): SamplerRequest => Sampler =
      if Set("bestcandidate", "pmj02bn", "maxmindist")(name) then
        site.warn(s"sampler \"$name\": scrambled Sobol' points are used, which are at least as even")
      if name == "adaptive" then
        site.warn(s"sampler \"adaptive\" is not supported yet; ${most()} samples are taken in every pixel")
      val s = seed()
      request =>
        val n = if name == "adaptive" then request.spp.getOrElse(most()) else count(request)
        OwenSobolSampler(n, request.seed ^ s)

  object ZSobol extends SamplerRecipe("zsobol"):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => ZSobolSampler(count(request), request.width, request.height, request.seed ^ s)

  object Halton extends SamplerRecipe("halton"):
    protected def make()(using Site): SamplerRequest => Sampler =
      val s = seed()
      request => HaltonSampler(count(request), request.seed ^ s)

  object Stratified extends Recipe[SamplerRequest => Sampler]("stratified"):
    private val x = integer("xsamples", "strata along x")(if v2 then 2 else 4)
    private val y = integer("ysamples", "strata along y")(if v2 then 2 else 4)
    private val jitter = bool("jitter", "a random place in each stratum, or its middle")(true)
    private val seed = integer("seed", "of the random numbers", onlyV4)(0)
    irrelevant("dimensions")
    protected def make()(using Site): SamplerRequest => Sampler =
      val (nx, ny, j, s) = (Math.max(1, x()), Math.max(1, y()), jitter(), seed())
      request =>
        // Another count is split into the most nearly square strata
        val (a, b) = request.spp.fold((nx, ny)): n =>
          val side = (1 to Math.sqrt(n.toDouble).toInt).filter(n % _ == 0).max
          (n / side, side)
        StratifiedSampler(a, b, j, request.seed ^ s)

/** Recipes of cameras; they want to know the film's width and height. */
object Cameras:
  val all: Recipes[(Transform, Int, Int) => Camera] = Recipes(
    "camera",
    Vector(Perspective, Orthographic),
    Vector("environment", "spherical", "realistic", "omni", "rtf")
      .map(_ -> "a perspective camera is used")
      .toMap
  )

  abstract class ProjectiveRecipe(name: String) extends Recipe[(Transform, Int, Int) => Camera](name):
    private val aspect = float("frameaspectratio", "width over height; default: the image's")(0f)
    private val window = numbers("screenwindow", "float[4]", "left right bottom top of the film")
    private val lens = float("lensradius", "of the aperture; 0: a pinhole")(0f)
    private val focus = float("focaldistance", "to the plane in focus")(if v4 then 1e6f else 1e30f)
    private val open = float("shutteropen", "time at which the shutter opens")(0f)
    private val close = float("shutterclose", "time at which the shutter closes")(1f)
    irrelevant("hither", "yon")

    protected def setup(toWorld: Transform, width: Int, height: Int)(using site: Site): ProjectiveSetup =
      val _ = (open(), close())
      val ratio = if aspect() > 0f then aspect() else width.toFloat / height
      val screen = window() match
        case Array(l, r, b, t) => (l, r, b, t)
        case other =>
          if other.nonEmpty then site.error("`screenwindow` takes left right bottom top")
          if ratio > 1f then (-ratio, ratio, -1f, 1f) else (-1f, 1f, -1f / ratio, 1f / ratio)
      ProjectiveSetup(toWorld, width, height, screen, lens(), focus())

  object Perspective extends ProjectiveRecipe("perspective"):
    private val fov = float("fov", "angle of the shorter side of the view, degrees")(90f)
    private val half = float("halffov", "half of `fov`", untilV3)(45f)
    protected def make()(using site: Site): (Transform, Int, Int) => Camera =
      val angle = half.given_().map(_ * 2f).getOrElse(fov())
      if !(angle > 0f && angle < 180f) then site.error(s"`fov` lies between 0 and 180 degrees; found $angle")
      (toWorld, width, height) => PerspectiveCamera(setup(toWorld, width, height), clamp(angle, 1e-3f, 179.9f))

  object Orthographic extends ProjectiveRecipe("orthographic"):
    protected def make()(using Site): (Transform, Int, Int) => Camera =
      (toWorld, width, height) => OrthographicCamera(setup(toWorld, width, height))

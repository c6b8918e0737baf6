package candela.build

import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.aov.ImageLayer
import candela.build.cameras.Cameras
import candela.build.film.{FilmSettings, Films, Filters}
import candela.build.integrators.IntegratorPlan
import candela.build.sampling.{FirstSampling, SamplerPlan, SamplerRequest, Samplers}
import candela.cameras.{Camera, FilmFrame, MovingCamera, PixelCone, Shutter}
import candela.film.{Filter, PixelBounds}
import candela.math.*
import candela.sampling.Sampler
import candela.scenefile.Resolution
import candela.settings.{RenderRegion, RenderSettings}

/** The image to render.
  *
  * @param width  width of the full image in pixels: that of the film, unless another is asked for
  * @param layers requested AOVs
  */
private[build] final case class ImageSetup(
    film: FilmSettings,
    width: Int,
    height: Int,
    filter: Filter,
    layers: Vector[ImageLayer]
):
  def frame: FilmFrame = FilmFrame(width, height, film.diagonal)

  /** Pixels beyond which no samples are taken: those of the scene's film. */
  def sampleWindow: Option[PixelBounds] =
    Option.unless(film.samplesBorder)(crop(None, RenderSettings()))

  /** Bounds of the pixels to render.
    *
    * @param window the integrator's window of the full image, if any
    */
  def crop(window: Option[PixelBounds], settings: RenderSettings): PixelBounds =
    // The image may have another size than the film. In Double, as a pixel's number must not be
    // rounded up
    def x(at: Double) = Math.ceil(at * width / film.width).toInt
    def y(at: Double) = Math.ceil(at * height / film.height).toInt
    def clipped(p: PixelBounds) = PixelBounds(
      Math.max(p.x0, 0),
      Math.max(p.y0, 0),
      Math.min(p.x1, width),
      Math.min(p.y1, height)
    )
    def edge(fraction: Float, size: Int) =
      candela.math.clamp(Math.ceil((size * fraction).toDouble).toInt, 0, size)
    def byParts(x0: Float, x1: Float, y0: Float, y1: Float) =
      PixelBounds(edge(x0, width), edge(y0, height), edge(x1, width), edge(y1, height))
    val c = film.crop
    val onFilm = settings.region match
      case RenderRegion.Window(x0, x1, y0, y1) => byParts(x0, x1, y0, y1)
      case RenderRegion.Whole if film.inPixels =>
        clipped(PixelBounds(x(c(0)), y(c(2)), x(c(1)), y(c(3))))
      case RenderRegion.Whole => byParts(c(0), c(1), c(2), c(3))
      case _ => clipped(settings.region.pixels.get)
    val isAsked = settings.region != RenderRegion.Whole
    val bounds = window.filterNot(_ => isAsked).fold(onFilm): w =>
      PixelBounds(
        Math.max(onFilm.x0, x(w.x0)),
        Math.max(onFilm.y0, y(w.y0)),
        Math.min(onFilm.x1, x(w.x1)),
        Math.min(onFilm.y1, y(w.y1))
      )
    if bounds.width < 1 || bounds.height < 1 then
      throw SceneError(
        Problem(
          Code.OptionMisfit,
          Severity.Error,
          None,
          settings.region.pixels match
            case Some(p) => s"pixels ${p.x0},${p.x1},${p.y0},${p.y1} are outside $width×$height"
            case None =>
              val cropWindow = settings.region match
                case RenderRegion.Window(x0, x1, y0, y1) => Seq(x0, x1, y0, y1)
                case _ => c.toSeq
              s"the crop window ${cropWindow.mkString(" ")}, with `pixelbounds`, has no pixel of " +
                s"$width×$height"
        )
      )
    bounds

private[build] object ImageSetup:
  def of(context: BuildContext, settings: RenderSettings): ImageSetup =
    val film = context.build(context.description.film, Films.all, context.defaults.film)
    val filter = context.build(context.description.filter, Filters.all, context.defaults.filter)
    val layers =
      if settings.preview then Vector.empty else (film.layers ++ settings.layers).distinct
    val resolution = settings.reading.resolution.orElse:
      if settings.preview then Some(Preview.resolution(film.width, film.height))
      else Option.when(settings.quick)(Resolution.Percent(25))
    val (width, height) =
      resolution.fold((film.width, film.height))(_.of(film.width, film.height))
    ImageSetup(film, width, height, filter, layers)

/** Settings of sampling.
  *
  * @param points    which points the sampler takes, and why
  * @param samples   samples per pixel, if not set by the sampler
  * @param footprint size of a sample's footprint, in pixels
  * @param remarks   on the number of samples, if the sampler is used
  * @param first     whether a pixel needs all samples, if it doesn't always; samples its first ones
  */
private[build] final case class SamplingSetup(
    sampler: Sampler,
    points: String,
    samples: Option[Int],
    footprint: Float,
    remarks: Vector[String],
    first: Option[(FirstSampling, Sampler)]
)

private[build] object SamplingSetup:
  /** pbrt-v4 shrinks footprints by the sample density, down to an eighth at most. */
  private val SharpestV4 = 0.125f

  def of(
      context: BuildContext,
      settings: RenderSettings,
      image: ImageSetup,
      integrator: IntegratorPlan,
      footprint: Option[Float]
  ): SamplingSetup =
    val samples =
      settings.samples.orElse(Option.when(settings.quick)(1)).orElse(integrator.samples)
    val effective = context.resources.settings
    val request = SamplerRequest(samples, effective.seed)
    val default = context.defaults.sampler
    val plan = context.build(context.description.sampler, Samplers.all, default)(request)
    val chosen = plan.points(settings.choices.points)
    val points = if plan.count <= chosen.maxSamples then chosen else SamplerPlan.Best
    val sampler = points.sampler(plan.count, plan.seed, image.width, image.height)
    val replaced = Option.when(points != chosen):
      s"\"${chosen.word}\" has at most ${chosen.maxSamples} samples per pixel, " +
        s"not ${plan.count}; using ${points.meaning}"
    // pbrt rounds a scene's own number, too
    val rounded = Option.when(settings.samples.exists(_ != sampler.samplesPerPixel)):
      s"\"${points.word}\" takes ${sampler.samplesPerPixel} samples per pixel, the next power " +
        s"of two, not ${plan.count}"
    val density = 1f / sqrt(sampler.samplesPerPixel.toFloat)
    SamplingSetup(
      sampler,
      if points == chosen then plan.describe(settings.choices.points) else points.meaning,
      samples,
      if effective.centers then 1f
      else if footprint.isDefined then footprint.get
      else if context.isV4 then Math.max(SharpestV4, density)
      else density,
      replaced.toVector ++ rounded,
      // Other samples are taken if these differ: points of another seed
      plan.first.map: first =>
        first -> points.sampler(first.asInPbrt.minSamples, ~plan.seed, image.width, image.height)
    )

/** The placed camera.
  *
  * @param motion  motion, if animated
  * @param toWorld camera-to-world transform at the start
  */
private[build] final case class CameraSetup(
    camera: Camera,
    shutter: Shutter,
    motion: Option[Motion],
    toWorld: Transform
):
  /** World-to-camera motion. */
  def fromWorld: Motion = motion.fold(Still(toWorld.inverse))(InverseMotion(_))

  /** @param size size of a sample's footprint, in pixels */
  def cone(image: ImageSetup, size: Float): PixelCone =
    PixelCone.of(camera, eye, image.width, image.height, size)

  /** Where it is, at shutter open. */
  def eye: Vec3 = toWorld.point(Vec3.Zero)

private[build] object CameraSetup:
  def of(context: BuildContext, image: ImageSetup): CameraSetup =
    val description = context.description
    val fromWorld = description.worldToCamera
    for c <- description.camera do
      if fromWorld.start.isFlat then
        context.problems.error(Code.Transform, c.pos, "the camera's transform is singular")
      else if fromWorld.isAnimated && !Motions.moves(fromWorld) then
        context.problems.warn(Code.NotAnimated, c.pos, Motions.notAnimated("this camera"))
    val plan = context.build(description.camera, Cameras.all, "perspective")
    val toWorld = fromWorld.start.inverse
    val motions = Motions(description, context.origin.position)
    val motion = motions.camera
    for c <- description.camera if motion.nonEmpty do
      motions.warnOfMirror(fromWorld, c.pos, context.problems)
    val camera = motion match
      case Some(moving) => MovingCamera(plan.create(Transform.Identity, image.frame), moving)
      case None => plan.create(toWorld, image.frame)
    CameraSetup(camera, plan.shutter, motion, toWorld)

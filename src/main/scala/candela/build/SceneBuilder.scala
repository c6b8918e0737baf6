package candela.build

import candela.base.{Parallel, Problem, SceneError, Severity}
import candela.build.cameras.Cameras
import candela.build.film.{FilmSettings, Films, Filters}
import candela.build.integrators.{Integrators, Renderers}
import candela.build.recipe.*
import candela.build.sampling.{SamplerRequest, Samplers}
import candela.build.settings.OptionRecipe
import candela.cameras.{FilmFrame, MovingCamera, PixelCone, Shutter}
import candela.color.ColorBasis
import candela.film.{FilterReach, Layer, PixelBounds, SpectralBands, VisibleSurface}
import candela.math.*
import candela.render.{LayerPlan, RenderPlan}
import candela.sampling.IndependentSampler
import candela.scene.Footprints
import candela.scenefile.{Declaration, Dialect, SceneDescription}

/** What the person at the command line asks for beside what the scene says.
  *
  * @param spp        samples per pixel instead of the scene's
  * @param quick      a sixteenth of the pixels, one sample each
  * @param cropWindow x0, x1, y0, y1 as parts of the image, instead of the scene's
  * @param keepGoing  use stand-ins for what is missing
  * @param layers     what the image is to hold beside the scene's own
  * @param crew       does what can be divided
  */
final case class BuildOptions(
    spp: Option[Int] = None,
    seed: Int = 0,
    quick: Boolean = false,
    cropWindow: Option[(Float, Float, Float, Float)] = None,
    keepGoing: Boolean = false,
    layers: Vector[Layer] = Vector.empty,
    crew: Parallel = Parallel.Alone
)

/** Makes a render plan of a description: the bridge between the two towers.
  *
  * Each choice of a plainer object (see the features of the plan) is made here, once.
  */
object SceneBuilder:

  /** The plan, and warnings about what could not be honoured; throws [[SceneError]] with all
    * errors, those of the description among them.
    */
  def build(description: SceneDescription, options: BuildOptions): (RenderPlan, Vector[Problem]) =
    val problems = Findings(options.keepGoing, description.lost, description.errors)
    // pbrt-v4 multiplies spectra, the older ones sRGB components
    val basis = if description.dialect == Dialect.V4 then ColorBasis.Sharp else ColorBasis.Srgb
    val resources = Resources(basis, options.crew, options.seed)
    def site(d: Declaration) = Site(d, description.dialect, resources, problems)
    def view[A](given_ : Option[Declaration], recipes: Recipes[A], default: String): A =
      val fallback = Declaration(recipes.category, default, Vector.empty, NoPlace, NoFolder)
      given_.flatMap(d => recipes.build(site(d))).getOrElse(recipes.build(site(fallback)).get)

    val defaults = Defaults(description.dialect)
    val settings = OptionRecipe.build(
      site(Declaration("Option", "", description.options, NoPlace, NoFolder))
    )
    val film = view(description.film, Films.all, defaults.film)
    val (width, height) =
      if options.quick then (Math.max(1, film.width / 4), Math.max(1, film.height / 4))
      else (film.width, film.height)
    val filter = view(description.filter, Filters.all, defaults.filter)
    val named = view(description.integrator, Integrators.all, defaults.integrator)
    val integrator =
      description.renderer.flatMap(d => Renderers.all.build(site(d))).flatten.getOrElse(named)
    val spp = options.spp.orElse(Option.when(options.quick)(1)).orElse(integrator.samples)
    val sampler = view(description.sampler, Samplers.all, defaults.sampler)(
      SamplerRequest(spp, options.seed ^ settings.seed, width, height)
    )
    if description.worldToCamera.start.isFlat then
      description.camera.foreach(c => problems.error(c.at, "the camera's transform is singular"))
    else if description.worldToCamera.isAnimated && !Motions.moves(description.worldToCamera) then
      description.camera.foreach(c => problems.warn(c.at, Motions.stands("this camera")))
    val cameraPlan = view(description.camera, Cameras.all, "perspective")
    val motions = Motions(description)
    val frame = FilmFrame(width, height, film.diagonal)
    val camera = motions.camera match
      case Some(motion) => MovingCamera(cameraPlan.make(Transform.Identity, frame), motion)
      case None => cameraPlan.make(description.worldToCamera.start.inverse, frame)
    val layers = (film.layers ++ options.layers).distinct
    for layer <- layers if layer.needsFootprints do
      resources.askForFootprints(s"the image's ${layer.channels.mkString(" and ")}")
    val shutter = cameraPlan.shutter
    // pbrt-v4's images are the brighter the longer the shutter is open
    val exposure = if description.dialect == Dialect.V4 then shutter.duration else 1f
    val isV4 = description.dialect == Dialect.V4
    val density = 1f / sqrt(sampler.samplesPerPixel.toFloat)
    val scale = if isV4 then Math.max(SharpestV4, density) else density
    val eye = description.worldToCamera.start.inverse.point(Vec3.Zero)
    def footprints =
      val cone = Option.when(isV4)(PixelCone.of(camera, eye, width, height, scale))
      Footprints(integrator.followsSpecular, cone)
    val world =
      WorldBuilder(description, integrator, shutter, resources, problems).build(footprints)
    val method = world.method
    if method.seesLightPaths && !camera.isTraceable then
      for at <- description.camera.map(_.at) do
        problems.warn(
          at,
          "paths from the lights are not joined with this camera yet: light that they alone " +
            "find there, like that of a point by way of glass, is left out"
        )
    val usesSampler = method.takesCameraSamples
    if !usesSampler && layers.nonEmpty then
      for at <- description.integrator.orElse(description.renderer).map(_.at) do
        problems.warn(at, "chains of paths find no layers: the image has its colours alone")
    // Layers belong to the pixel that they were begun for
    val shares = layers.isEmpty && method.canShareSamples && FilterReach.isUseful(filter)
    problems.stopAtErrors()
    val plan = RenderPlan(
      width = width,
      height = height,
      crop = cropOf(film, integrator.window, width, height, options),
      camera = camera,
      filter = filter,
      // Chains draw numbers of their own, as many as they are told
      sampler =
        if usesSampler then sampler else IndependentSampler(spp.getOrElse(1), options.seed),
      method = method,
      basis = basis,
      limit = film.limit(exposure),
      development = film.development.copy(scale = film.development.scale * exposure),
      filename = film.filename,
      features = ("dialect", description.dialect.toString.toLowerCase) +:
        ("integrator", integrator.describe) +: world.features :+
        ("motion", moving(motions.camera.isDefined, world.moves, shutter)) :+
        ("layers", layersOf(layers, film.development.bands)) :+
        ("samples", if shares then "in all pixels of the filter" else "in one pixel each"),
      differentialScale = if resources.footprintUses.isEmpty then 0f else scale,
      shutter = Option.when(motions.camera.isDefined || world.moves)(shutter),
      weighsFirst = isV4,
      layers = Option.when(layers.nonEmpty && usesSampler):
        val space =
          if film.layersInWorld then Still(Transform.Identity)
          else motions.camera.fold(Still(description.worldToCamera.start))(InverseMotion(_))
        LayerPlan(layers, VisibleSurface(world.scene, space, basis))
      ,
      sharesSamples = shares
    )
    (plan, problems.result)

  private[build] val NoPlace = candela.base.SourcePos("", 0, 0)
  private val NoFolder = java.nio.file.Path.of("")

  /** pbrt-v4 shrinks footprints by the density of samples to an eighth at most. */
  private val SharpestV4 = 0.125f

  private def layersOf(layers: Vector[Layer], bands: Option[SpectralBands]): String =
    val all = layers.map(_.word) ++ bands.map(b => s"bands of wavelengths, ${b.describe}")
    if all.isEmpty then "none" else all.mkString(", ")

  private def moving(camera: Boolean, world: Boolean, shutter: Shutter): String =
    val what = Seq("camera" -> camera, "shapes" -> world).filter(_._2).map(_._1).mkString(" and ")
    if what.isEmpty then "none" else s"$what, from ${shutter.open} to ${shutter.close}"

  private def cropOf(
      film: FilmSettings,
      window: Option[PixelBounds],
      width: Int,
      height: Int,
      options: BuildOptions
  ): PixelBounds =
    val (x0, x1, y0, y1) = options.cropWindow.getOrElse:
      val c = film.crop
      if film.inPixels then
        (c(0) / film.width, c(1) / film.width, c(2) / film.height, c(3) / film.height)
      else (c(0), c(1), c(2), c(3))
    def edge(part: Float, size: Int) =
      candela.math.clamp(Math.ceil((size * part).toDouble).toInt, 0, size)
    val onFilm = PixelBounds(edge(x0, width), edge(y0, height), edge(x1, width), edge(y1, height))
    val bounds = window.filter(_ => options.cropWindow.isEmpty).fold(onFilm): w =>
      // An image may be made smaller than the film
      def x(at: Int) = Math.ceil(at.toDouble * width / film.width).toInt
      def y(at: Int) = Math.ceil(at.toDouble * height / film.height).toInt
      PixelBounds(
        Math.max(onFilm.x0, x(w.x0)),
        Math.max(onFilm.y0, y(w.y0)),
        Math.min(onFilm.x1, x(w.x1)),
        Math.min(onFilm.y1, y(w.y1))
      )
    if bounds.width < 1 || bounds.height < 1 then
      throw SceneError(
        Problem(
          Severity.Error,
          None,
          s"the crop window $x0 $x1 $y0 $y1, with `pixelbounds`, holds no pixel of $width×$height"
        )
      )
    bounds

/** What each dialect does where the scene says nothing. */
private final case class Defaults(
    film: String,
    filter: String,
    sampler: String,
    integrator: String
)

private object Defaults:
  def apply(dialect: Dialect): Defaults = dialect match
    case Dialect.V2 => Defaults("image", "box", "lowdiscrepancy", "directlighting")
    case Dialect.V3 => Defaults("image", "box", "halton", "path")
    case Dialect.V4 => Defaults("rgb", "gaussian", "zsobol", "volpath")

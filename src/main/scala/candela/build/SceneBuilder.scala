package candela.build

import candela.base.{Parallel, Problem}
import candela.build.integrators.{IntegratorPlan, Integrators, Renderers}
import candela.build.settings.{OptionRecipe, SceneSettings}
import candela.film.{FilterReach, Layer, SpectralBands, VisibleSurface}
import candela.math.{Still, Transform}
import candela.render.{LayerPlan, RenderMethod, RenderPlan}
import candela.sampling.IndependentSampler
import candela.scene.Footprints
import candela.scenefile.SceneDescription

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
    val context = BuildContext(description, options)
    val settings = sceneSettings(context)
    val image = ImageSetup.of(context, options)
    val integrator = integratorPlan(context)
    val sampling = SamplingSetup.of(context, options, settings.seed, image, integrator)
    val camera = CameraSetup.of(context, image)
    for layer <- image.layers if layer.needsFootprints do
      context.resources.askForFootprints(s"the image's ${layer.channels.mkString(" and ")}")
    def footprints =
      val cone = Option.when(context.isV4)(camera.cone(image, sampling.footprint))
      Footprints(integrator.followsSpecular, cone)
    val world = WorldBuilder(context, integrator, camera.shutter).build(footprints)
    warnOfLimits(context, image, camera, world.method)
    context.problems.stopAtErrors()
    (plan(context, options, image, integrator, sampling, camera, world), context.problems.result)

  private def sceneSettings(context: BuildContext): SceneSettings =
    val statement = context.unwritten("Option", "").copy(params = context.description.options)
    OptionRecipe.build(context.site(statement))

  /** v2's renderers stand above its integrators. */
  private def integratorPlan(context: BuildContext): IntegratorPlan =
    val description = context.description
    val default = context.defaults.integrator
    val named = context.made(description.integrator, Integrators.all, default)
    val renderer = description.renderer.flatMap(d => Renderers.all.build(context.site(d)))
    renderer.flatten.getOrElse(named)

  private def warnOfLimits(
      context: BuildContext,
      image: ImageSetup,
      camera: CameraSetup,
      method: RenderMethod
  ): Unit =
    val description = context.description
    if method.seesLightPaths && !camera.camera.isTraceable then
      for at <- description.camera.map(_.at) do
        context.problems.warn(
          at,
          "paths from the lights are not joined with this camera yet: light that they alone " +
            "find there, like that of a point by way of glass, is left out"
        )
    if !method.takesCameraSamples && image.layers.nonEmpty then
      for at <- description.integrator.orElse(description.renderer).map(_.at) do
        context.problems.warn(
          at,
          "chains of paths find no layers: the image has its colours alone"
        )

  private def plan(
      context: BuildContext,
      options: BuildOptions,
      image: ImageSetup,
      integrator: IntegratorPlan,
      sampling: SamplingSetup,
      camera: CameraSetup,
      world: World
  ): RenderPlan =
    val film = image.film
    val method = world.method
    // pbrt-v4's images are the brighter the longer the shutter is open
    val exposure = if context.isV4 then camera.shutter.duration else 1f
    // Layers belong to the pixel that they were begun for
    val shares =
      image.layers.isEmpty && method.canShareSamples && FilterReach.isUseful(image.filter)
    val usesSampler = method.takesCameraSamples
    val moves = camera.motion.isDefined || world.moves
    RenderPlan(
      width = image.width,
      height = image.height,
      crop = image.crop(integrator.window, options),
      camera = camera.camera,
      filter = image.filter,
      // Chains draw numbers of their own, as many as they are told
      sampler =
        if usesSampler then sampling.sampler
        else IndependentSampler(sampling.samples.getOrElse(1), options.seed),
      method = method,
      basis = context.resources.basis,
      limit = film.limit(exposure),
      development = film.development.copy(scale = film.development.scale * exposure),
      filename = film.filename,
      features = Vector(
        "dialect" -> context.dialect.toString.toLowerCase,
        "integrator" -> integrator.describe
      ) ++ world.features ++ Vector(
        "motion" -> moving(camera, world),
        "layers" -> described(image.layers, film.development.bands),
        "samples" -> (if shares then "in all pixels of the filter" else "in one pixel each")
      ),
      differentialScale =
        if context.resources.footprintUses.isEmpty then 0f else sampling.footprint,
      shutter = Option.when(moves)(camera.shutter),
      weighsFirst = context.isV4,
      layers = Option.when(image.layers.nonEmpty && usesSampler):
        val space = if film.layersInWorld then Still(Transform.Identity) else camera.fromWorld
        LayerPlan(image.layers, VisibleSurface(world.scene, space, context.resources.basis))
      ,
      sharesSamples = shares
    )

  private def described(layers: Vector[Layer], bands: Option[SpectralBands]): String =
    val all = layers.map(_.word) ++ bands.map(b => s"bands of wavelengths, ${b.describe}")
    if all.isEmpty then "none" else all.mkString(", ")

  private def moving(camera: CameraSetup, world: World): String =
    val movers = Seq("camera" -> camera.motion.isDefined, "shapes" -> world.moves)
    val what = movers.filter(_._2).map(_._1).mkString(" and ")
    val shutter = camera.shutter
    if what.isEmpty then "none" else s"$what, from ${shutter.open} to ${shutter.close}"

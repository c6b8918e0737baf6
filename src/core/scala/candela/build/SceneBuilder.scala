package candela.build

import candela.base.JavaHeap
import candela.concurrency.Parallel
import candela.diagnostics.{Code, Limit, Problem}
import candela.accel.tracing.Hierarchies
import candela.aov.LayerFilm
import candela.build.integrators.{IntegratorPlan, Integrators, Renderers}
import candela.film.{Fireflies, PixelBounds}
import candela.render.{FilmSize, RenderMethod, RenderPlan}
import candela.scenefile.SceneDescription
import candela.settings.{BuildControl, LightGrouping, RenderSettings}

/** Builds a render plan from a description. Connects scene files to rendering.
  *
  * Selects the simplest exact specialisation of each object, once (see the features of the plan).
  */
object SceneBuilder:
  /** Pixels of which the films of a rendering can have all their values. */
  private val MaxPixels = Int.MaxValue / 16

  /** Returns the plan and warnings about unsupported features. Throws [[SceneError]] with all
    * errors, including those of the description.
    *
    * @param pool executes divisible work
    * @param heap bytes that the scene may take
    */
  def build(
      description: SceneDescription,
      settings: RenderSettings = RenderSettings(),
      control: BuildControl = BuildControl(),
      pool: Parallel = Parallel.Alone,
      heap: Long = JavaHeap.limit
  ): (RenderPlan, Vector[Problem]) =
    val built = buildViewed(description, settings, control, pool, heap)
    (built.plan, built.warnings)

  /** Likewise, for other cameras, too. */
  def buildViewed(
      description: SceneDescription,
      settings: RenderSettings,
      control: BuildControl,
      pool: Parallel,
      heap: Long = JavaHeap.limit
  ): BuiltScene =
    val context = BuildContext(description, settings, control, pool)
    def integratorIn(context: BuildContext) =
      if settings.preview then Preview.integrator(context) else integratorPlan(context)
    val view = ViewSetup(context, settings, control, integratorIn)
    import view.{camera, crop, film, image, integrator, sampling}
    for layer <- image.layers if layer.needsFootprints do
      context.resources.askForFootprints(
        s"the image's ${layer.channelsOf(Vector.empty).mkString(" and ")}"
      )
    if crop.pixels > MaxPixels then
      context.problems.error(
        Code.TooLarge,
        context.placeOf(context.description.film),
        s"can't render ${crop.width}×${crop.height} pixels at once, at most $MaxPixels",
        Some("give the film a crop window, or render parts of it with --cropwindow")
      )
    val perPixel = view.samplesOverride.getOrElse(sampling.sampler.samplesPerPixel)
    checkLimits(context, image, crop, perPixel)
    val filmSize =
      FilmSize.lowerBound(crop.pixels, perPixel, image.layers, image.film.development.bands)
    val memory = MemoryCheck(heap, filmSize, context)
    val samples = crop.pixels * perPixel
    Hierarchies.expect(samples, pool, context.resources.warmUps)
    val world =
      WorldBuilder(
        context,
        integrator,
        integratorIn,
        camera.shutter,
        samples,
        settings.colorMode,
        image.film.camera,
        Option.when(film.layers.exists(_.isLight) || dimsLight(settings)):
          settings.lightGroups.getOrElse(LightGrouping.Statements)
        ,
        memory
      ).build(view.footprints)
    context.problems.stopAtErrors()
    warnOfLimits(context, film, camera, world.method)
    if !settings.preview then
      FireflyLimits(context, settings.fireflies).check(world.method)
      IdleSettings(context, settings).check(world)
    context.problems.stopAtErrors()
    val renderPlan = ViewPlan(view, world).plan
    checkSize(context, renderPlan)
    for why <- control.cache.save() do
      context.problems.warn(Code.Unwritable, None, s"$why; the scene cache gets no more files")
    for remark <- control.cache.remark do
      context.problems.warn(Code.OutputConflict, None, remark)
    BuiltScene(renderPlan, context.problems.result, context.origin.position): (seen, others) =>
      val near = RenderOrigin.of(seen).position == context.origin.position
      Option.when(near)(ViewSetup(context.seenAs(seen), others, control, _ => integrator))
        .filter(v => v.camera.shutter == camera.shutter || !world.moves)
        .map: view =>
          val plan = ViewPlan(view, world.seenFrom(view.camera.eye, view.footprints)).plan
          view.context.problems.stopAtErrors()
          plan

  /** Whether arrays can have all values of the pixels, their layers and bands. */
  private def checkSize(context: BuildContext, plan: RenderPlan): Unit =
    val bands = plan.bands.orElse(plan.development.bands).fold(0)(_.channels.size)
    val layers = plan.layers.fold(0L)(asked => LayerFilm.size(asked.layers, asked.groups))
    if plan.crop.pixels * (layers + 2 * bands) > Int.MaxValue - 8 then
      val largest = Vector("layers" -> layers, "bands" -> bands.toLong).maxBy(_._2)._1
      context.problems.error(
        Code.TooLarge,
        context.placeOf(context.description.film),
        s"can't render ${plan.crop.width}×${plan.crop.height} pixels with all their $largest " +
          "at once",
        Some(s"ask for fewer $largest, or render parts of the image with --cropwindow")
      )
      context.problems.stopAtErrors()

  /** What a film and its samples need, and how long paths are.
    *
    * @throws Refusal if that is more than allowed
    */
  private def checkLimits(
      context: BuildContext,
      image: ImageSetup,
      crop: PixelBounds,
      samples: Int
  ): Unit =
    val (allowance, scene) = (context.resources.allowance, context.description)
    val pixels = crop.pixels * (1L + image.layers.size)
    allowance.check(Limit.Pixels, pixels, scene.film.map(_.pos)):
      val layers = if image.layers.isEmpty then "" else s" in ${1 + image.layers.size} layers"
      s"an image of ${crop.width}×${crop.height} pixels$layers"
    allowance.check(Limit.Samples, samples, scene.sampler.map(_.pos)):
      s"$samples samples per pixel"
    for
      d <- Vector(scene.integrator, scene.renderer, scene.volumeIntegrator).flatten
      p <- d.param("maxdepth")
      depth <- p.ints
    do
      allowance.check(Limit.Depth, depth, Some(p.valuesAt))(s"paths of $depth scattering events")

  /** The integrator; v2's renderers may override it. */
  private def integratorPlan(context: BuildContext): IntegratorPlan =
    val description = context.description
    val default = context.defaults.integrator
    val named = context.build(description.integrator, Integrators.all, default)
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
      for at <- description.camera.map(_.pos) do
        context.problems.warn(
          Code.IntegratorLacks,
          at,
          "light-traced paths can't reach this camera yet: caustics from point lights will be " +
            "missing"
        )
    if !method.takesCameraSamples && image.layers.nonEmpty then
      for at <- description.integrator.orElse(description.renderer).map(_.pos) do
        context.problems.warn(
          Code.IntegratorLacks,
          at,
          "Metropolis rendering writes no AOVs; the image contains colour only"
        )
    else
      val divided = image.layers.filter(_.dividesLight)
      if divided.nonEmpty && !method.dividesLight then
        context.problems.error(
          Code.IntegratorLacks,
          context.placeOf(description.integrator.orElse(description.renderer)),
          s"this integrator does not separate light: AOVs ${divided.map(_.word).mkString(", ")} " +
            "need \"path\" or \"volpath\""
        )

  private def dimsLight(settings: RenderSettings): Boolean = settings.fireflies match
    case Fireflies.Clamped(_) => !settings.preview
    case _ => false

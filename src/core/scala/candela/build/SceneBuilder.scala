package candela.build

import candela.base.JavaHeap
import candela.concurrency.Parallel
import candela.diagnostics.{Code, Limit, Problem}
import candela.accel.tracing.Hierarchies
import candela.aov.{
  FirstHit, ImageLayer, Layer, LayerFilm, NamedLayer, ScreenMotion, StrategyLayer, VisibleSurface
}
import candela.build.integrators.{IntegratorPlan, Integrators, Renderers}
import candela.color.ColorBasis
import candela.film.{Development, FilterReach, Fireflies, PixelBounds, SpectralBands}
import candela.guiding.Guide
import candela.integrators.CausticsMode
import candela.math.{Motion, Still}
import candela.render.{
  AdaptiveSampling, ErrorFile, FilmSize, LayerPlan, Passes, RenderMethod, RenderPlan,
  SampleDifference, Tiles
}
import candela.sampling.{CenteredSampler, IndependentSampler}
import candela.scene.{Footprints, SurfaceNames}
import candela.scenefile.SceneDescription
import candela.settings.{BuildControl, Choices, LightGrouping, RenderSettings, SkyView}

/** Builds a render plan from a description. Connects scene files to rendering.
  *
  * Selects the simplest exact specialisation of each object, once (see the features of the plan).
  */
object SceneBuilder:
  /** Pixels of which the films of a rendering can have all their values. */
  private val MostPixels = Int.MaxValue / 16

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
    val context = BuildContext(description, settings, control, pool)
    val film = ImageSetup.of(context, settings)
    val samplesOverride =
      control.samples.orElse(Option.when(settings.isEndless)(RenderPlan.Endless))
    def integratorIn(context: BuildContext) =
      if settings.preview then Preview.integrator(context) else integratorPlan(context)
    val integrator = integratorIn(context)
    val image = film.copy(layers = film.layers ++ integrator.layers)
    val sampling = SamplingSetup.of(context, settings, image, integrator, control.footprint)
    val camera = CameraSetup.of(context, image)
    for layer <- image.layers if layer.needsFootprints do
      context.resources.askForFootprints(
        s"the image's ${layer.channelsOf(Vector.empty).mkString(" and ")}"
      )
    def footprints =
      val cone = Option.when(context.isV4 && !context.resources.settings.unfiltered):
        camera.cone(image, sampling.footprint)
      Footprints(integrator.followsSpecular, cone)
    val crop = image.crop(integrator.window, settings)
    if crop.pixels > MostPixels then
      context.problems.error(
        Code.TooLarge,
        context.placeOf(context.description.film),
        s"can't render ${crop.width}×${crop.height} pixels at once, at most $MostPixels",
        Some("give the film a crop window, or render parts of it with --cropwindow")
      )
    checkLimits(context, image, crop, sampling)
    val perPixel = samplesOverride.getOrElse(sampling.sampler.samplesPerPixel)
    val filmSize = Option.when(control.isRendered):
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
      ).build(footprints)
    context.problems.stopAtErrors()
    warnOfLimits(context, film, camera, world.method)
    if !settings.preview then
      FireflyLimits(context, settings.fireflies).check(world.method)
      IdleSettings(context, settings).check(world)
    context.problems.stopAtErrors()
    // A method that was chosen instead may have none
    val imageOfMethod = if world.method.strategies.isDefined then image else film
    val renderPlan =
      plan(
        context, settings, samplesOverride, imageOfMethod, crop, integrator, sampling, camera, world
      )
    checkSize(context, renderPlan)
    for why <- control.cache.save() do
      context.problems.warn(Code.Unwritable, None, s"$why; the scene cache gets no more files")
    for remark <- control.cache.remark do
      context.problems.warn(Code.OutputConflict, None, remark)
    (renderPlan, context.problems.result)

  private def footprint(context: BuildContext, sampling: SamplingSetup): Float =
    val isUnfiltered = context.resources.settings.unfiltered
    if context.resources.footprintUses.isEmpty || isUnfiltered then 0f
    else sampling.footprint

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
      sampling: SamplingSetup
  ): Unit =
    val (allowance, scene) = (context.resources.allowance, context.description)
    val pixels = crop.pixels * (1L + image.layers.size)
    allowance.check(Limit.Pixels, pixels, scene.film.map(_.pos)):
      val layers = if image.layers.isEmpty then "" else s" in ${1 + image.layers.size} layers"
      s"an image of ${crop.width}×${crop.height} pixels$layers"
    val samples = sampling.sampler.samplesPerPixel
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

  private def dialect(scene: SceneDescription): String =
    val reason = if scene.dialectReason.isEmpty then "" else s", ${scene.dialectReason}"
    scene.dialect.toString.toLowerCase + reason + scene.additions.fold("")(", " + _)

  private def dimsLight(settings: RenderSettings): Boolean = settings.fireflies match
    case Fireflies.Clamped(_) => !settings.preview
    case _ => false

  private def plan(
      context: BuildContext,
      settings: RenderSettings,
      samplesOverride: Option[Int],
      image: ImageSetup,
      crop: PixelBounds,
      integrator: IntegratorPlan,
      sampling: SamplingSetup,
      camera: CameraSetup,
      world: World
  ): RenderPlan =
    val method = world.method
    val effective = context.resources.settings
    // pbrt-v4 scales images by the shutter time
    val exposure = if context.isV4 then camera.shutter.duration else 1f
    val film = if world.color.isSpectral then image.film.spectral(exposure) else image.film
    val bands = film.development.bands
      .filter(_ => world.color.isSpectral && method.hasWavelengths)
      .map(_.withBases(world.color.bases))
    // AOVs belong to the pixel of the camera sample
    val shares =
      image.layers.isEmpty && bands.isEmpty && method.canShareSamples && !effective.centers &&
        FilterReach.isUseful(image.filter)
    val usesSampler = method.takesCameraSamples
    val samples = samplesOverride.getOrElse(sampling.sampler.samplesPerPixel)
    if usesSampler && !settings.preview then
      for remark <- sampling.remarks do
        context.problems.warn(Code.AsInPbrt, context.description.sampler.map(_.pos), remark)
    val adaptive =
      if samplesOverride.isEmpty then adaptiveSampling(context, sampling, world) else None
    val firstSamples =
      sampling.first.filter(_ => adaptive.isDefined).fold("")((first, _) =>
        s": ${first.asInPbrt.describe}"
      )
    val moves = camera.motion.isDefined || world.moves
    RenderPlan(
      width = image.width,
      height = image.height,
      crop = crop,
      camera = camera.camera,
      filter = image.filter,
      // Markov chains ignore the sampler
      sampler =
        if usesSampler then
          if effective.centers then CenteredSampler(sampling.sampler, moves) else sampling.sampler
        else IndependentSampler(sampling.samples.getOrElse(1), settings.seed),
      method = method,
      basis = if world.color.isSpectral then ColorBasis.Srgb else context.resources.basis,
      limit = if settings.preview then None else film.limit(exposure),
      development =
        if settings.preview then Development()
        else film.development.copy(scale = film.development.scale * exposure),
      filename = film.filename,
      facts = Vector(
        "dialect" -> dialect(context.description),
        "integrator" -> integrator.describe
      ) ++ context.origin.describe.map("origin" -> _) ++ world.features ++
        caustics(context, world) ++ context.resources.imagesInWords.map("images" -> _) ++ Vector(
          "motion" -> moving(camera, world),
          "layers" -> described(image.layers, film.development.bands),
          "sampler" -> (if usesSampler then sampling.points + firstSamples
                        else "none: Markov chains")
        ) ++ FireflyLimits.feature(settings) ++
        guiding(context, settings, method, samples, crop.pixels),
      differentialScale = footprint(context, sampling),
      shutter = Option.when(moves)(camera.shutter),
      weighsFirst = context.isV4,
      layers = Option.when(image.layers.nonEmpty && usesSampler):
        val space =
          if film.layersInWorld then Still(context.origin.position.fromOrigin) else camera.fromWorld
        layerPlan(context, image, camera, world, space, hidesSky(context, settings, image))
      ,
      sharesSamples = shares,
      bands = bands,
      isCentered = effective.centers,
      errors =
        for r <- effective.output.reference; f <- effective.output.errors yield ErrorFile(r, f),
      fireflies = if settings.preview then Fireflies.Kept else settings.fireflies,
      lights = world.scene.lights.length,
      built = world.costs,
      sampleWindow = image.sampleWindow,
      samples = samplesOverride,
      sight = Some(world.sight),
      hidesSky = hidesSky(context, settings, image),
      adaptive = adaptive
    )

  /** Of pbrt-v2's adaptive sampler. Not of paths that learn or wait for a pilot's choice: those
    * belong to passes over the whole image.
    */
  private def adaptiveSampling(
      context: BuildContext,
      sampling: SamplingSetup,
      world: World
  ): Option[AdaptiveSampling] =
    def warn(code: Code, message: String): Unit =
      context.problems.warn(code, context.description.sampler.map(_.pos), message)
    sampling.first.flatMap: (asked, sampler) =>
      val first = asked.asInPbrt
      world.method match
        case _: Tiles if !context.resources.settings.centers =>
          if first != asked then
            warn(
              Code.AsInPbrt,
              s"taking ${first.minSamples} or ${first.maxSamples} samples per pixel: they are " +
                "different powers of two, as in pbrt-v2"
            )
          val difference =
            if first.byShape then SampleDifference.Shape(world.scene) else SampleDifference.Contrast
          Some(AdaptiveSampling(sampler, difference))
        case _ =>
          warn(
            Code.IdleOption,
            s"every pixel takes ${first.maxSamples} samples: the sampler \"adaptive\" goes with " +
              "none of --guiding, --caustics and --disable-pixel-jitter"
          )
          None

  /** Pictures with alpha show what is behind them, instead of the sky: but not those that the
    * program of the dialect makes.
    */
  private def hidesSky(context: BuildContext, settings: RenderSettings, image: ImageSetup) =
    def isAsked = settings.layers.contains(Layer.Alpha) && image.layers.contains(Layer.Alpha)
    settings.sky.fold(isAsked && !context.rules.skyCovers)(_ == SkyView.Hide)

  /** What is said of guiding, if it was asked for or chosen. */
  private def guiding(
      context: BuildContext,
      settings: RenderSettings,
      method: RenderMethod,
      samples: Int,
      pixels: Long
  ): Option[(String, String)] =
    val reason = if settings.choices.byGoal then s"; ${Choices.Why}" else ""
    Option.when(context.resources.settings.learning.isDefined):
      "guiding" -> (method.guide match
        case Some(_) if method.pilot.exists(_.blurs) => s"none: ${Passes.Unguided}"
        case Some(learning) => Guide(learning, samples, pixels).describe + reason
        case None => "none: only path tracing without pbrt-v2's volumes is guided")

  /** What is said of caustics before the pilot, if they are looked for. */
  private def caustics(context: BuildContext, world: World): Vector[(String, String)] =
    if context.resources.settings.choices.caustics == CausticsMode.Off then Vector.empty
    else if world.method.pilot.isDefined then world.caustics.features
    else Vector("caustics" -> s"none: ${IdleSettings.NoCaustics}")

  private def layerPlan(
      context: BuildContext,
      image: ImageSetup,
      camera: CameraSetup,
      world: World,
      space: Motion,
      hidesSky: Boolean
  ): LayerPlan =
    def hasAny(some: Layer*) = some.exists(image.layers.contains)
    val names =
      if hasAny(Layer.CryptoObject, Layer.CryptoMaterial) then world.surfaceNames
      else SurfaceNames.Empty
    val motion =
      if hasAny(Layer.Motion) then ScreenMotion.of(camera.camera, camera.shutter) else None
    val first = Option.when(image.layers.exists(_.isInstanceOf[NamedLayer])):
      FirstHit(world.scene, context.origin.position, context.resources.basis)
    val scene = context.description
    val surface = VisibleSurface(
      world.scene,
      space,
      context.resources.basis,
      names,
      motion,
      scene.hidesEmitters,
      skyCovers = context.rules.skyCovers && !scene.hidesEmitters && !hidesSky &&
        world.scene.environments.nonEmpty,
      first
    )
    val groups = world.method.strategies.map(_.groups)
      .orElse(world.scene.lightGroups.filter(_ => world.method.dividesLight))
    LayerPlan(image.layers, surface, names, groups)

  private def described(layers: Vector[ImageLayer], bands: Option[SpectralBands]): String =
    val (strategies, others) = layers.partition(_.isInstanceOf[StrategyLayer])
    val apart = Option.when(strategies.nonEmpty)(s"${strategies.size} strategies")
    val descriptions =
      others.map(_.word) ++ apart ++ bands.map(b => s"bands of wavelengths, ${b.describe}")
    if descriptions.isEmpty then "none" else descriptions.mkString(", ")

  private def moving(camera: CameraSetup, world: World): String =
    val movers = Seq("camera" -> camera.motion.isDefined, "shapes" -> world.moves)
    val names = movers.filter(_._2).map(_._1).mkString(" and ")
    val shutter = camera.shutter
    if names.isEmpty then "none" else s"$names, from ${shutter.open} to ${shutter.close}"

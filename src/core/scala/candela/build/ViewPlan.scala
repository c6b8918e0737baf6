package candela.build

import candela.diagnostics.{Code, Limit}
import candela.aov.{
  FirstHit, HitValue, ImageLayer, Layer, NamedLayer, ScreenMotion, StrategyLayer, VisibleSurface
}
import candela.build.integrators.IntegratorPlan
import candela.color.ColorBasis
import candela.film.{Development, FilterReach, Fireflies, PixelBounds, SpectralBands}
import candela.guiding.Guide
import candela.integrators.CausticsMode
import candela.math.{Motion, Still}
import candela.render.{
  AdaptiveSampling, ErrorFile, LayerPlan, Passes, RenderMethod, RenderPlan, SampleDifference, Tiles
}
import candela.sampling.{CenteredSampler, IndependentSampler}
import candela.scene.{Footprints, SurfaceNames}
import candela.scenefile.Dialect
import candela.settings.{BuildControl, Choices, RenderSettings, SkyView}

import java.util.Locale

/** What depends on camera, film and sampler, but not on the world.
  *
  * @param integratorIn the integrator, in the colour basis of a context
  */
private[build] final class ViewSetup(
    val context: BuildContext,
    val settings: RenderSettings,
    control: BuildControl,
    integratorIn: BuildContext => IntegratorPlan
):
  val film: ImageSetup = ImageSetup.of(context, settings)

  /** Samples per pixel to take at most, whatever is asked for later. */
  val maxSamples: Int = context.resources.allowance.capped(Limit.Samples, RenderPlan.Endless)

  /** Samples per pixel, if not as many as the sampler's points are made for. */
  val samplesOverride: Option[Int] =
    val count = control.samples.orElse(Option.when(settings.isEndless)(RenderPlan.Endless))
    count.map(n => if n == RenderPlan.Endless then maxSamples else n)
  val integrator: IntegratorPlan = integratorIn(context)
  val image: ImageSetup = film.copy(layers = film.layers ++ integrator.layers)
  val sampling: SamplingSetup =
    SamplingSetup.of(context, settings, image, integrator, control.footprint)
  val camera: CameraSetup = CameraSetup.of(context, image)
  val crop: PixelBounds = image.crop(integrator.window, settings)

  def footprints: Footprints =
    val cone = Option.when(context.isV4 && !context.resources.settings.unfiltered):
      camera.cone(image, sampling.footprint)
    Footprints(integrator.followsSpecular, cone)

/** Plans the rendering of a world as a camera sees it. */
private[build] final class ViewPlan(view: ViewSetup, world: World):
  import view.{camera, context, crop, integrator, sampling, samplesOverride, settings}
  private val method: RenderMethod = world.method

  // A method that was chosen instead may have none
  private val image: ImageSetup = if method.strategies.isDefined then view.image else view.film

  def plan: RenderPlan =
    val effective = context.resources.settings
    // pbrt-v4 scales images by the shutter time
    val exposure = if context.rules.dialect == Dialect.V4 then camera.shutter.duration else 1f
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
      if samplesOverride.isEmpty then adaptiveSampling else None
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
        "dialect" -> dialect,
        "integrator" -> integrator.describe
      ) ++ context.origin.describe.map("origin" -> _) ++ world.features ++
        caustics ++ context.resources.imagesInWords.map("images" -> _) ++ Vector(
          "motion" -> moving,
          "layers" -> described(image.layers, film.development.bands),
          "sampler" -> (if usesSampler then sampling.points + firstSamples
                        else "none: Markov chains")
        ) ++ FireflyLimits.feature(settings) ++
        guiding(samples),
      differentialScale = footprint,
      shutter = Option.when(moves)(camera.shutter),
      weighsFirst = context.isV4,
      layers = Option.when(image.layers.nonEmpty && usesSampler):
        val space =
          if film.layersInWorld then Still(context.origin.position.fromOrigin) else camera.fromWorld
        layerPlan(space)
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
      maxSamples = view.maxSamples,
      sight = Some(world.sight),
      hidesSky = hidesSky,
      adaptive = adaptive
    )

  private def footprint: Float =
    val isUnfiltered = context.resources.settings.unfiltered
    if context.resources.footprintUses.isEmpty || isUnfiltered then 0f
    else sampling.footprint

  private def dialect: String =
    val scene = context.description
    val reason = if scene.dialectReason.isEmpty then "" else s", ${scene.dialectReason}"
    scene.dialect.toString.toLowerCase(Locale.ROOT) + reason + scene.additions.fold("")(", " + _)

  /** Of pbrt-v2's adaptive sampler. Not of paths that learn or wait for a pilot's choice: those
    * belong to passes over the whole image.
    */
  private def adaptiveSampling: Option[AdaptiveSampling] =
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
  private def hidesSky: Boolean =
    def isAsked = settings.layers.contains(Layer.Alpha) && image.layers.contains(Layer.Alpha)
    settings.sky.fold(isAsked && !context.rules.skyCovers)(_ == SkyView.Hide)

  /** What is said of guiding, if it was asked for or chosen. */
  private def guiding(samples: Int): Option[(String, String)] =
    val reason = if settings.choices.byGoal then s"; ${Choices.Why}" else ""
    Option.when(context.resources.settings.learning.isDefined):
      "guiding" -> (method.guide match
        case Some(_) if method.pilot.exists(_.blurs) => s"none: ${Passes.Unguided}"
        case Some(learning) => Guide(learning, samples, crop.pixels).describe + reason
        case None => "none: only path tracing without pbrt-v2's volumes is guided")

  /** What is said of caustics before the pilot, if they are looked for. */
  private def caustics: Vector[(String, String)] =
    if context.resources.settings.choices.caustics == CausticsMode.Off then Vector.empty
    else if world.method.pilot.isDefined then world.caustics.features
    else Vector("caustics" -> s"none: ${IdleSettings.NoCaustics}")

  private def layerPlan(space: Motion): LayerPlan =
    def hasAny(some: Layer*) = some.exists(image.layers.contains)
    val names =
      if hasAny(Layer.CryptoObject, Layer.CryptoMaterial) then world.surfaceNames
      else SurfaceNames.Empty
    val motion =
      if hasAny(Layer.Motion) then ScreenMotion.of(camera.camera, camera.shutter) else None
    val first = Option.when(image.layers.exists(_.isInstanceOf[NamedLayer])):
      FirstHit(world.scene, context.origin.position, context.resources.basis)
    val wantsCoverage = image.layers.exists:
      case NamedLayer(_, value, _) => value == HitValue.Colors
      case layer => layer == Layer.Alpha
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
      first,
      if wantsCoverage then world.transmittance else None
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

  private def moving: String =
    val movers = Seq("camera" -> camera.motion.isDefined, "shapes" -> world.moves)
    val names = movers.filter(_._2).map(_._1).mkString(" and ")
    val shutter = camera.shutter
    if names.isEmpty then "none" else s"$names, from ${shutter.open} to ${shutter.close}"

package candela.build.integrators

import candela.bidirectional.*
import candela.build.recipe.*
import candela.film.{Splats, View}
import candela.integrators.LightTransport.RouletteAfter
import candela.integrators.{PathLimits, PathTracer, VolumePathTracer, WalkOptions}
import candela.render.RenderMethod
import candela.scene.Scene
import candela.scenefile.Dialect

/** How [[BidirectionalPathTracer]] is made, for all that is rendered by it. */
private[build] object BidirectionalPlans:

  /** @param name by which the scene asked for it */
  def plan(name: String, depth: Int, widens: Boolean = false)(using site: Site): IntegratorPlan =
    val most = Math.max(0, depth)
    val dialect = site.dialect
    val shown = if name == "bdpt" then name else s"bdpt for $name"
    IntegratorPlan(
      (scene, _) => RenderMethod.SplattedTiles(v => tracer(scene, v, most, widens)(v.splats)),
      samplesBsdf = false,
      s"$shown, up to $most scattering events" + (if widens then ", regularized" else ""),
      followsSpecular = dialect == Dialect.V4,
      throughMedia = Option.when(dialect != Dialect.V2): (scene, media) =>
        site.warn(
          s"\"$name\" sees no media and no borders of media yet: \"volpath\" is used, $Lack"
        )
        VolumePathTracer(
          scene,
          media,
          PathLimits(most, seesThrough = dialect == Dialect.V3),
          WalkOptions(widens, subsurface = scene.hasSubsurface)
        )
      ,
      throughVolumes = Some: (scene, _, march) =>
        site.warn(s"\"$name\" sees no volumes yet: \"path\" is used, $Lack")
        PathTracer(scene, PathLimits(most), volumes = march)
    )

  private def tracer(scene: Scene, view: View, depth: Int, widens: Boolean)(splats: Splats)(
      using site: Site
  ): BidirectionalPathTracer =
    val compresses = site.dialect != Dialect.V2
    BidirectionalPathTracer(
      scene, view.camera, splats, depth, RouletteAfter, compresses, widens
    )

  /** Of [[MarkovChains]]: where there are media or volumes, as above.
    *
    * @param mutations for each pixel
    */
  def metropolis(
      name: String,
      depth: Int,
      mutations: Int,
      settings: MetropolisSettings,
      widens: Boolean = false
  )(using site: Site): IntegratorPlan =
    for
      (count, what) <- Seq(
        mutations -> "mutations",
        settings.bootstrap -> "bootstrap samples",
        settings.chains -> "chains"
      )
      if count < 1
    do site.error(s"there must be $what; found $count")
    if !(settings.largeStep >= 0f && settings.largeStep <= 1f) then
      site.error(s"`largestepprobability` must be in [0, 1]; found ${settings.largeStep}")
    val most = Math.max(0, depth)
    val seeded = settings.copy(seed = site.resources.seed)
    plan(name, depth, widens).copy(
      method = (scene, _) =>
        RenderMethod.Chains(
          v => MarkovChains(tracer(scene, v, most, widens), seeded, v),
          v => tracer(scene, v, most, widens)(v.splats)
        ),
      describe = s"$name, up to $most scattering events, ${settings.chains} chains",
      samples = Some(Math.max(1, mutations))
    )

  private val Lack =
    "the same light but for that of lamps that are points, by way of mirrors or glass"

/** How [[PhotonPasses]] are made. */
private[build] object PhotonPlans:

  /** @param depth  scattering events of a path from the camera
    * @param passes if the scene says how many
    */
  def plan(name: String, depth: Int, settings: PhotonSettings, passes: Option[Int])(
      using site: Site
  ): IntegratorPlan =
    val most = Math.max(0, depth)
    if !(settings.radius > 0f) then site.error("photons need a radius above 0")
    val seeded = settings.copy(seed = settings.seed ^ site.resources.seed)
    BidirectionalPlans
      .plan(name, most)
      .copy(
        method = (scene, _) => RenderMethod.Passes(PhotonPasses(scene, most, seeded, _)),
        describe =
          s"$name, up to $most scattering events, photons within ${settings.radius} at first",
        samples = passes,
        throughMedia = None
      )

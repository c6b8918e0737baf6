package candela.build.integrators

import candela.caustics.{
  CausticChoice, CausticLight, CausticPasses, CausticPilot, CausticTracer, LightPathChoice,
  PhotonChoice, PhotonPilot, PilotResult
}
import candela.diagnostics.Code
import candela.aov.LightParts
import candela.build.recipe.*
import candela.film.{Fireflies, View}
import candela.guiding.Guide
import candela.integrators.*
import candela.media.SceneMedia
import candela.render.{GuidedSplats, MethodPilot, Passes, Piloted, RenderMethod, SplattedTiles}
import candela.scene.Scene
import candela.scenefile.Dialect

/** Methods of path tracers, which can be guided, and beside which light paths can look for caustics
  * where a pilot finds that it pays.
  */
private object CausticMethod:
  /** Makes the integrator of a worker: with these options, guided or not, and dividing light in a
    * given place or its own.
    */
  type Tracer = (Scene, PathOptions, Guide | Null, LightParts | Null) => Integrator

  def apply(scene: Scene, limits: PathLimits, options: PathOptions, media: Option[SceneMedia])(
      tracer: Tracer
  )(using site: Site): RenderMethod =
    val mode = site.resources.settings.choices.caustics
    val cameraPathsOnly =
      GuidedMethod(scene)((workerScene, guide, parts) => tracer(workerScene, options, guide, parts))
    if mode == CausticsMode.Off then cameraPathsOnly
    else if !scene.mayHaveCasters then withoutCaustics("no surface casts caustics", cameraPathsOnly)
    else
      reasonAgainst(scene, options) match
        case Some(why) if mode == CausticsMode.Photons =>
          reject(why, "write --caustics off", cameraPathsOnly)
        case None if mode == CausticsMode.Photons && scene.lightGroups.isDefined =>
          val reason = "photons do not separate light, as --fireflies clamp and AOVs of light need"
          reject(reason, "write --caustics on: light paths do", cameraPathsOnly)
        case Some(why) => withoutCaustics(why, cameraPathsOnly)
        case None =>
          val light = CausticLight(
            scene.casters,
            limits.maxDepth,
            compresses = site.dialect != Dialect.V2,
            findsAll = mode != CausticsMode.Auto,
            beneath = options.subsurface,
            media
          )
          val beside = Beside(scene, options, light, tracer)
          val takesPhotons = mode == CausticsMode.Photons
          Piloted(
            cameraPathsOnly,
            MethodPilot(
              beside.pilot(mode, _).result,
              beside.method,
              connects = !takesPhotons,
              blurs = takesPhotons
            )
          )

  private def withoutCaustics(why: String, cameraPathsOnly: RenderMethod): RenderMethod =
    Piloted(cameraPathsOnly, MethodPilot.unchanged(why, cameraPathsOnly))

  private def reject(why: String, instead: String, cameraPathsOnly: RenderMethod)(using
      site: Site
  ): RenderMethod =
    site.error(Code.OptionMisfit, s"--caustics photons: $why", Some(instead))
    cameraPathsOnly

  /** Why light paths would find other light than the camera's, if they would. */
  private def reasonAgainst(scene: Scene, options: PathOptions): Option[String] =
    if options.regularizes then Some("\"regularize\" roughens the surfaces that cast caustics")
    else if scene.hasInterfaces && options.interfaces.stopsLight then
      Some("\"path\" stops light at interfaces of media; \"volpath\" does not")
    else if options.countsPassed && scene.hasInterfaces then
      Some("interfaces count as scattering events")
    else if options.crossesPanes && scene.hasPanes then
      Some("light samples cross thin glass here")
    else None

  private final class Beside(
      scene: Scene,
      options: PathOptions,
      light: CausticLight,
      tracer: Tracer
  )(using site: Site):
    private def reweights = site.resources.settings.fireflies == Fireflies.Reweighted

    def pilot(mode: CausticsMode, view: View): PilotResult = mode match
      case CausticsMode.On => byLightPaths(view)
      case CausticsMode.Photons => byPhotons(view, mustPay = false)
      // Photons neither divide light nor have outliers
      case _ if scene.lightGroups.isDefined || reweights => byLightPaths(view)
      case _ => byLightPaths(view).better(byPhotons(view, mustPay = true), PhotonMargin)

    private def byLightPaths(view: View): PilotResult =
      def paths(weights: CausticWeights) = tracer(scene, weighed(weights), null, null)
      if !view.camera.isTraceable then PilotResult.none("light paths can't reach this camera")
      else CausticPilot(scene, view, light, site.resources.pool, paths).run()

    /** @param mustPay are photons only taken where they pay? */
    private def byPhotons(view: View, mustPay: Boolean): PilotResult =
      def paths(photons: Option[PhotonLight]) =
        tracer(scene, options.copy(photons = photons), null, null)
      PhotonPilot(scene, view, light, site.resources.pool, Option.when(mustPay)(paths)).run()

    def method(choice: CausticChoice): RenderMethod = choice match
      case paths: LightPathChoice => beside(paths)
      case photons: PhotonChoice => gathering(photons)

    /** Paths of the camera, beside light paths. */
    private def beside(choice: LightPathChoice): RenderMethod =
      def makers(view: View, guide: Option[Guide]) = WorkerIntegrators(scene): workerScene =>
        val chosen = light.copy(casters = choice.casters)
        val cameraOptions = weighed(choice.weights(workerScene, view))
        val paths = guide match
          case None => tracer(workerScene, cameraOptions, null, null)
          case Some(by) =>
            PartlyGuided(
              workerScene,
              by,
              tracer(workerScene, cameraOptions, by, _),
              tracer(workerScene, cameraOptions, null, _)
            )
        CausticTracer(workerScene, paths, view, chosen, choice.perSample)
      SplattedTiles(
        makers(_, None),
        beside = true,
        site.resources.settings.learning.map(GuidedSplats(
          _,
          (view, guide) => makers(view, Some(guide))
        )),
        Option.when(light.findsAll && scene.lights.exists(_.isDelta)):
          "also delta lights, through and off smooth surfaces"
      )

    /** Paths of the camera that take caustics from photons. */
    private def gathering(choice: PhotonChoice): RenderMethod =
      Passes(
        CausticPasses(
          scene,
          light.copy(casters = choice.casters),
          choice.radius,
          // The choice is that of another basis, in which a medium may not shine
          choice.bringsAll && light.suitsPhotons,
          site.resources.seed,
          _,
          (workerScene, map) => tracer(workerScene, options.copy(photons = Some(map)), null, null)
        ),
        bias = Some("photon maps of shrinking radius (Knaus, Zwicker 2011)")
      )

    private def weighed(weights: CausticWeights): PathOptions =
      options.copy(caustics = Some(weights))

  /** By how much photons must be better than light paths, which have no bias, and can be guided. */
  private val PhotonMargin = 2.0

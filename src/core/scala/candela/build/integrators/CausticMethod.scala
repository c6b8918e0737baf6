package candela.build.integrators

import candela.aov.LightParts
import candela.base.Code
import candela.bidirectional.{
  AimPilot, CausticChoice, CausticLight, CausticPasses, CausticPilot, CausticTracer, PhotonPilot,
  SeenLight
}
import candela.build.recipe.*
import candela.film.View
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
    val alone = GuidedMethod(scene)((over, guide, parts) => tracer(over, options, guide, parts))
    if mode == CausticsMode.Off then alone
    else if !scene.mayHaveCasters then without("no surface casts caustics", alone)
    else
      isOut(scene, options) match
        case Some(why) if mode == CausticsMode.Photons => refuse(why, "write --caustics off", alone)
        case None if mode == CausticsMode.Photons && scene.lightGroups.isDefined =>
          val why = "photons do not separate light, as --fireflies clamp and AOVs of light need"
          refuse(why, "write --caustics on: light paths do", alone)
        case Some(why) => without(why, alone)
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
          if mode == CausticsMode.Photons then
            val pool = site.resources.pool
            def run(view: View) = PhotonPilot(scene, view, light, pool).run()
            Piloted(alone, MethodPilot(run, beside.photons, connects = false, blurs = true))
          else
            Piloted(alone, MethodPilot(beside.pilot, beside.method, connects = true, blurs = false))

  private def without(why: String, alone: RenderMethod): RenderMethod =
    Piloted(alone, MethodPilot.without(why))

  private def refuse(why: String, instead: String, alone: RenderMethod)(using
      site: Site
  ): RenderMethod =
    site.error(Code.OptionMisfit, s"--caustics photons: $why", Some(instead))
    alone

  /** Why light paths would find other light than the camera's, if they would. */
  private def isOut(scene: Scene, options: PathOptions): Option[String] =
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
    /** Light paths, and photons that guide the camera's, where they pay. */
    def pilot(view: View): (Option[CausticChoice], String) =
      val pilot = CausticPilot(
        scene,
        view,
        light,
        site.resources.pool,
        (weights, aim) => sees(scene, weighed(weights), aim, null, null)
      )
      val (found, told) = pilot.run()
      val beside = found.fold(options): choice =>
        weighed(choice.weights(scene, view))
      val (aim, expected) = AimPilot(
        scene,
        view,
        light,
        site.resources.pool,
        (field, guide) => tracer(scene, beside.copy(aim = field), guide, null),
        walks => tracer(scene, beside.copy(manifolds = Some(walks)), null, null)
      ).run()
      val how =
        if aim.exists(_.walked.isDefined) then "manifold walks find" else "photons guide paths to"
      val guiding = s"$how light seen by way of specular surfaces: $expected"
      aim match
        case None => (found, s"$told; $expected")
        case _ if found.isEmpty =>
          (
            Some(CausticChoice(light.casters, perSample = 0f, aim = aim)),
            s"$guiding; light paths: $told"
          )
        case _ =>
          val both = found.map(choice => pilot.balanced(choice.copy(aim = aim)))
          (both, s"light paths: $told; $guiding, with ${both.fold("")(_.paths)}")

    def method(choice: CausticChoice): RenderMethod =
      def aimed(own: PathOptions)(over: Scene, guide: Guide | Null, parts: LightParts | Null) =
        sees(over, own, choice.aim, guide, parts)
      if !choice.hasLightPaths then GuidedMethod(scene)(aimed(options))
      else
        def makers(view: View, guide: Option[Guide]) = WorkerIntegrators(scene): over =>
          val chosen = light.copy(casters = choice.casters)
          val own = aimed(weighed(choice.weights(over, view)))
          val paths = guide match
            case None => own(over, null, null)
            case Some(by) => PartlyGuided(over, by, own(over, by, _), own(over, null, _))
          CausticTracer(over, paths, view, chosen, choice.perSample, choice.ofEmitters)
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
    def photons(choice: CausticChoice): RenderMethod =
      val chosen = light.copy(casters = choice.casters)
      Passes(
        CausticPasses(
          scene,
          chosen,
          choice.radius,
          // The choice is that of another basis, in which a medium may not shine
          choice.bringsAll && light.suitsPhotons,
          site.resources.seed,
          _,
          (over, map) => tracer(over, options.copy(photons = Some(map)), null, null)
        ),
        bias = Some("photon maps of shrinking radius (Knaus, Zwicker 2011)")
      )

    /** Paths that look for light which specular surfaces show. */
    private def sees(
        over: Scene,
        own: PathOptions,
        aim: Option[SeenLight],
        guide: Guide | Null,
        parts: LightParts | Null
    ): Integrator =
      val field = aim.flatMap(_.guiding)
      val learns = if guide == null && field.isDefined then Guide.unlearning else guide
      tracer(over, own.copy(manifolds = walked(over, aim), aim = field), learns, parts)

    /** Manifold walks between surfaces; media would attenuate the chains. */
    private def walked(over: Scene, aim: Option[SeenLight]): Option[Manifolds] =
      val asked = aim.flatMap(_.walked)
      if light.media.isDefined || !light.findsAll && asked.isEmpty then None
      else
        val walks = Manifolds(
          over,
          light.maxDepth,
          i => if over.lights(i).isDelta then light.findsAll else asked.exists(_.emitters(i)),
          aim.flatMap(_.seeding).orNull,
          usual = asked.fold(0f)(_.usual)
        )
        Option.unless(walks.isEmpty)(walks)

    private def weighed(weights: CausticWeights): PathOptions =
      options.copy(caustics = Some(weights))

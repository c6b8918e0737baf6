package candela.build

import candela.diagnostics.{Code, SourcePos}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.render.Passes
import candela.settings.{PointChoice, RenderSettings}

/** Warns of options of the command line that the scene's integrator does not heed. */
private[build] final class IdleSettings(context: BuildContext, settings: RenderSettings):

  def check(world: World): Unit =
    val method = world.method
    val isAsked = settings.caustics.exists(_ != CausticsMode.Off)
    idle("caustics", isAsked && method.pilot.isEmpty)(IdleSettings.NoCaustics)
    val isBiased = method.pilot.exists(_.blurs)
    val isGuided = method.guide.isDefined && !isBiased
    idle("guiding", settings.guiding.exists(_ != GuidingMode.Off) && !isGuided):
      if context.isV2 && context.description.volumes.nonEmpty then
        "paths among pbrt-v2's volumes are not guided"
      else if isBiased then Passes.Unguided
      else s"$integrator is not guided; \"path\" and \"volpath\" are"
    val takesNone = !method.takesCameraSamples
    val chains = s"the Markov chains of $integrator take no points of a sampler"
    val isNamed = settings.points match
      case Some(PointChoice.Named(_)) => true
      case _ => false
    idle("sampler", takesNone && isNamed)(chains)
    idle("disable-pixel-jitter", takesNone && settings.centers)(chains)
    idle("sky", settings.sky.nonEmpty && takesNone)(s"the Markov chains of $integrator show it")
    idle("sky", settings.sky.nonEmpty && !takesNone && world.scene.environments.isEmpty):
      "the scene has no sky"
    idle("disable-wavelength-jitter", settings.oneColorSet && !world.color.isSpectral):
      "rendering is RGB; --color spectral uses wavelengths"
    def isDisplaced = context.description.shapes.exists(_.shape.param("displacement").isDefined) ||
      context.description.objects.values.exists(_.exists(_.shape.param("displacement").isDefined))
    idle("displacement-edge-scale", settings.edgeScale.isDefined && !isDisplaced):
      "no mesh is displaced"

  private def idle(option: String, isSo: Boolean)(why: => String): Unit =
    if isSo then context.problems.warn(Code.IdleOption, position, s"--$option has no effect: $why")

  private def integrator: String =
    val described = context.description.renderer.filter(_.name == "metropolis")
      .orElse(context.description.integrator)
    s"\"${described.fold(context.defaults.integrator)(_.name)}\""

  private def position: Option[SourcePos] =
    context.description.renderer.orElse(context.description.integrator).map(_.pos)

private[build] object IdleSettings:
  /** Why light paths don't look for caustics. */
  val NoCaustics: String = "only \"path\" and \"volpath\" look for caustics"

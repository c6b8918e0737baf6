package candela.build

import candela.diagnostics.Code
import candela.film.Fireflies
import candela.render.{Passes, RenderMethod}
import candela.settings.RenderSettings

/** Which methods of rendering have samples that fireflies can be taken from. */
private[build] final class FireflyLimits(context: BuildContext, fireflies: Fireflies):

  /** @param method before its pilot, if it has one, has chosen another */
  def check(method: RenderMethod): Unit = fireflies match
    case Fireflies.Kept => ()
    case Fireflies.Reweighted =>
      val photons = method.pilot.filter(_.blurs).map(_ => Passes.WithoutOutliers)
      method.withoutOutliers.orElse(photons) match
        case Some(why) => refuse(why)
        case None if method.seesLightPaths || method.pilot.exists(_.connects) =>
          context.problems.warn(
            Code.OptionMisfit,
            position,
            "--fireflies reweight leaves light paths that reach the camera as they are"
          )
        case None => ()
    case Fireflies.Clamped(_) if method.dividesLight => ()
    case Fireflies.Clamped(_) =>
      val reason = method.withoutOutliers.filter(_ => !method.takesCameraSamples)
      refuse(reason.getOrElse(
        "this integrator does not separate indirect light; \"path\" and \"volpath\" do"
      ))

  private def refuse(why: String): Unit =
    context.problems.error(Code.OptionMisfit, position, s"--fireflies ${fireflies.word}: $why")

  private def position =
    val description = context.description
    context.placeOf(description.integrator.orElse(description.renderer))

private[build] object FireflyLimits:
  /** What `--explain` says, if anything is done. */
  def feature(settings: RenderSettings): Option[(String, String)] =
    val effect = settings.fireflies match
      case _ if settings.preview => None
      case Fireflies.Kept => None
      case Fireflies.Reweighted =>
        Some("light that few samples have found is left out; 24 to 48 bytes per pixel and level " +
          "of brightness; the image is biased")
      case Fireflies.Clamped(most) =>
        Some(s"indirect light of samples is limited to $most; the image is biased")
    effect.map("fireflies" -> _)

package candela.build

import candela.base.Code

import candela.film.Fireflies
import candela.render.RenderMethod

/** Which methods of rendering have samples that fireflies can be taken from. */
private[build] final class FireflyLimits(context: BuildContext, fireflies: Fireflies):

  def check(method: RenderMethod): Unit = (fireflies, method) match
    case (Fireflies.Kept, _) => ()
    case (_, RenderMethod.Chains(_, _, _)) =>
      refuse("Markov chains visit light by its brightness: no sample is too bright")
    case (Fireflies.Reweighted, RenderMethod.Passes(_, _)) =>
      refuse("a photon brightens many samples alike, none of which is an outlier")
    case (Fireflies.Reweighted, RenderMethod.SplattedTiles(_, _, _, _)) =>
      context.problems.warn(
        Code.OptionMisfit,
        place,
        "--fireflies reweight leaves light paths that reach the camera as they are"
      )
    case (Fireflies.Clamped(_), _) if !method.dividesLight =>
      refuse("this integrator does not tell indirect light; \"path\" and \"volpath\" do")
    case _ => ()

  private def refuse(why: String): Unit =
    context.problems.error(Code.OptionMisfit, place, s"--fireflies ${fireflies.word}: $why")

  private def place =
    val description = context.description
    context.placeOf(description.integrator.orElse(description.renderer))

private[build] object FireflyLimits:
  /** What `--explain` says, if anything is done. */
  def feature(settings: RenderSettings): Option[(String, String)] =
    val what = settings.fireflies match
      case _ if settings.preview => None
      case Fireflies.Kept => None
      case Fireflies.Reweighted =>
        Some("light that few samples have found is left out; 24 to 48 bytes per pixel and level " +
          "of brightness; the image is biased")
      case Fireflies.Clamped(most) =>
        Some(s"indirect light of samples is limited to $most; the image is biased")
    what.map("fireflies" -> _)

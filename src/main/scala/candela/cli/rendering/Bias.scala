package candela.cli.rendering

import candela.cli.files.Denoising
import candela.cli.terminal.Figures
import candela.film.Fireflies
import candela.render.{RenderPlan, Rendering}

/** What makes an image biased, for its metadata and for reports. */
private[cli] object Bias:

  /** For image files: what was done, and the channels that it biased. */
  def metadata(
      plan: RenderPlan,
      rendering: Rendering,
      denoising: Option[Denoising]
  ): Vector[(String, String)] =
    val changed = fireflies(plan, rendering)
    val channels =
      changed.toVector.flatMap(_ => Vector("R", "G", "B")) ++
        denoising.toVector.flatMap(_ => Denoising.Channels)
    changed.map("fireflies" -> _).toVector ++
      denoising.map(d => "denoiser" -> d.describe) ++
      Option.when(channels.nonEmpty)("biased" -> channels.mkString(", "))

  /** What was done about fireflies, if anything. */
  def fireflies(plan: RenderPlan, rendering: Rendering): Option[String] = plan.fireflies match
    case Fireflies.Kept => None
    case Fireflies.Reweighted =>
      val lost = Figures.fixed(100 * rendering.film.leftOut, 2)
      Some(s"re-weighted (Zirr, Hanika, Dachsbacher 2018), $lost % of the light left out")
    case Fireflies.Clamped(most) => Some(s"indirect light of samples limited to $most")

package candela.cli.rendering

import candela.diagnostics.Code
import candela.cli.terminal.{Figures, ProblemText}
import candela.job.GoalRule
import candela.render.Rendering

/** What is said of a rendering that ended before its goal. */
private[cli] object MissedGoal:

  /** A warning, if all samples were taken before the goal was reached. */
  def warning(rule: GoalRule, rendering: Rendering): Option[String] =
    Option.when(rule.isMissed(rendering)):
      val time = rule.goal.time.map: asked =>
        s"the rendering ended after ${Figures.duration(rendering.seconds)}, " +
          s"not ${Figures.duration(asked)}"
      val error = rule.goal.error.map: asked =>
        val estimate = rule.errorAt(rendering.samplesDone)
        val formatted = estimate.fold("not known")(e => s"${Figures.percentage(e)}")
        s"the error is $formatted, not ${Figures.percentage(asked)}"
      val planned = Figures.count(rendering.samplesPerPixel, "sample")
      ProblemText.numbered(
        s"warning: ${(error ++ time).mkString(", and ")}: all $planned per pixel are taken; " +
          advice(rule.bySamples),
        Code.MissedGoal
      )

  private def advice(ending: GoalRule.Ending): String =
    if ending == GoalRule.Ending.Limit then "--limit allows no more: samples=N changes the limit"
    else "a larger --spp, or none, allows more"

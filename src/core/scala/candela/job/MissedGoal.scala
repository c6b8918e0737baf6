package candela.job

import candela.base.Figures
import candela.diagnostics.{Code, Problem, Severity}
import candela.render.Rendering

/** What is said of a rendering that ended before its goal. */
object MissedGoal:

  /** A warning, if all samples were taken before the goal was reached. */
  def problem(rule: GoalRule, rendering: Rendering): Option[Problem] =
    Option.when(rule.isMissed(rendering)):
      val time = rule.goal.time.map: asked =>
        s"the rendering ended after ${Figures.duration(rendering.seconds)}, " +
          s"not ${Figures.duration(asked)}"
      val error = rule.goal.error.map: asked =>
        if rendering.samplesDone < GoalRule.MinSamples then
          s"an error is known from ${GoalRule.MinSamples} samples per pixel on"
        else
          val estimate = rule.errorAt(rendering.samplesDone)
          val formatted = estimate.fold("not known")(e => s"${Figures.percentage(e)}")
          s"the error is $formatted, not ${Figures.percentage(asked)}"
      val planned = Figures.count(rendering.samplesPerPixel, "sample")
      val message = s"${(error ++ time).mkString(", and ")}: all $planned per pixel are taken"
      Problem(Code.MissedGoal, Severity.Warning, None, message, Some(advice(rule.bySamples)))

  private def advice(ending: GoalRule.Ending): String =
    if ending == GoalRule.Ending.Limit then "--limit allows no more: samples=N changes the limit"
    else "a larger --spp, or none, allows more"

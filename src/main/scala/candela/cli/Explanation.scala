package candela.cli

import candela.render.RenderPlan

import java.io.PrintStream

/** What a plan is made of, one line each: the choices that the builder made. */
object Explanation:
  def print(plan: RenderPlan, to: PrintStream): Unit =
    val width = plan.features.map(_._1.length).maxOption.getOrElse(0)
    for (what, value) <- plan.features do to.println(s"  ${what.padTo(width, ' ')}  $value")

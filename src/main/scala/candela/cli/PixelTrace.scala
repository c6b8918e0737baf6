package candela.cli

import candela.base.{Problem, SceneError}
import candela.render.{Renderer, RenderPlan}
import candela.scene.PathReport

import java.io.PrintStream

/** `candela render --pixel x,y --sample n --debug`: the path of one sample, in words. */
private[cli] object PixelTrace:
  def run(plan: RenderPlan, options: Options, out: PrintStream): ExitCode =
    val (x, y) = options.pixel.getOrElse((0, 0))
    val crop = plan.crop
    if x < crop.x0 || x >= crop.x1 || y < crop.y0 || y >= crop.y1 then
      val size = s"x ${crop.x0} until ${crop.x1}, y ${crop.y0} until ${crop.y1}"
      throw SceneError(Problem.general(s"there is no pixel $x,$y in the image: $size"))
    out.println(s"pixel ($x, $y), sample ${options.sample}")
    Renderer.trace(plan, x, y, options.sample, PathReport(out.println)) match
      case Some(light) => out.println(s"adds $light")
      case None => out.println("is left out: infinite or no number")
    out.flush()
    ExitCode.Done

package candela.bench

import candela.build.{BuildControl, RenderSettings, SceneBuilder}
import candela.cameras.CameraRays
import candela.film.FilterSampler
import candela.render.{RenderPlan, ThreadPool, Tiles}
import candela.scenefile.Parser

import java.lang.management.ManagementFactory
import java.nio.file.Path

/** What a camera path leaves for the garbage collector, by the JVM's own counter of the thread: one
  * line for each scene that is named.
  *
  * Paths are taken in one thread, over the whole image; those of the first passes, which warm up,
  * are not counted. Options: none.
  */
object Garbage:
  private val WarmUp = 24
  private val Passes = 8

  /** Samples of a long render, for which the SIMD kernels are loaded. */
  private val AsIf = 1024

  def main(scenes: Array[String]): Unit =
    for scene <- scenes do
      val description = Parser.readable(Path.of(scene), None, keepGoing = false)
      val settings = RenderSettings(samples = Some(AsIf))
      val (plan, _) = SceneBuilder.build(description, settings, BuildControl(ThreadPool(1)))
      val paths = Paths(plan)
      for pass <- 0 until WarmUp do paths.take(pass)
      val before = allocated()
      val started = cpu()
      for pass <- WarmUp until WarmUp + Passes do paths.take(pass)
      val count = Passes.toDouble * plan.width * plan.height
      val bytes = (allocated() - before) / count
      println(f"$scene: $bytes%.0f bytes and ${(cpu() - started) / count / 1e3}%.3f µs a path")

  private final class Paths(plan: RenderPlan):
    private val sampler = plan.sampler.copy()
    private val integrator = plan.method match
      case tiles: Tiles => tiles.integrators.make(None)
      case other => sys.error(s"only camera paths are counted: $other")
    private val filter = new FilterSampler(plan.filter)
    private val rays = CameraRays(plan.camera, plan.shutter, plan.differentialScale)
    private var sum = 0.0 // so that nothing is left out as unused

    def take(sample: Int): Unit =
      var y = 0
      while y < plan.height do
        var x = 0
        while x < plan.width do
          take(x, y, sample)
          x += 1
        y += 1

    private def take(x: Int, y: Int, sample: Int): Unit =
      sampler.start(x, y, sample)
      sampler.next2D()
      filter.sample(sampler.x, sampler.y)
      if rays.next(x + 0.5f + filter.dx, y + 0.5f + filter.dy, sampler) != 0f then
        sum += integrator.radiance(rays.ray, sampler).average

  private def allocated(): Long =
    ManagementFactory.getThreadMXBean match
      case counter: com.sun.management.ThreadMXBean =>
        counter.getThreadAllocatedBytes(Thread.currentThread.getId)
      case _ => sys.error("this JVM does not count what a thread allocates")

  private def cpu(): Long = ManagementFactory.getThreadMXBean.getCurrentThreadCpuTime

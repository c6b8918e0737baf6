package candela.bench

import candela.build.{ColorMode, RenderSettings}
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.job.{Preparation, SceneLoader}
import candela.render.{RenderPlan, WaveRendering}

import java.lang.management.ManagementFactory

/** The prototype of docs/decisions/0024-lanes.md: one thread, three numbers, no guiding.
  *
  * `check SCENE [SAMPLES]` renders by Candela's workers and by waves, and compares all bits of the
  * images. `scalar SCENE SAMPLES [SECONDS]` and `waves SCENE SAMPLES [SECONDS]` render by the one or
  * the other until so much processor time has passed, and print the process's after each pass.
  */
object Lanes:
  def main(args: Array[String]): Unit = args.toList match
    case "check" :: scene :: rest => check(scene, rest.headOption.fold(16)(_.toInt))
    case (by @ ("scalar" | "waves")) :: scene :: samples :: rest =>
      measure(by, scene, samples.toInt, rest.headOption.fold(Double.PositiveInfinity)(_.toDouble))
    case _ => sys.error("check SCENE [SAMPLES] | scalar|waves SCENE SAMPLES [SECONDS]")

  private val waveSamples = Integer.getInteger("candela.lanes.samples", 8).intValue

  private def plan(scene: String, samples: Int): RenderPlan =
    val settings = RenderSettings(
      samples = Some(samples),
      color = ColorMode.Rgb,
      guiding = Some(GuidingMode.Off),
      caustics = Some(CausticsMode.Off)
    )
    val made = SceneLoader.FromFile.load(scene, Preparation(settings)).plan
    for why <- WaveRendering(made, 1).obstacle do sys.error(s"waves can't render $why")
    made

  private def check(scene: String, samples: Int): Unit =
    val of = plan(scene, samples)
    val one = WaveRendering(of, waveSamples).scalar(_ => ()).toImage(1f).data
    val two = WaveRendering(of, waveSamples).waves(_ => (), atOnce = true).toImage(1f).data
    val bits = java.lang.Float.floatToRawIntBits
    val wrong = one.indices.count(i => bits(one(i)) != bits(two(i)))
    println(s"$scene, $samples samples: $wrong of ${one.length} numbers differ")
    if wrong > 0 then
      one.indices.filter(i => one(i) != two(i)).take(5)
        .foreach(i => println(s"${i / 3}: ${one(i)} ${two(i)}"))
      sys.exit(1)

  /** Process's processor time, in seconds. */
  private def cpu(): Double =
    ManagementFactory.getOperatingSystemMXBean
      .asInstanceOf[com.sun.management.OperatingSystemMXBean]
      .getProcessCpuTime * 1e-9

  private final class Enough extends RuntimeException

  private def measure(by: String, scene: String, samples: Int, seconds: Double): Unit =
    val of = plan(scene, samples)
    println(f"# built after ${cpu()}%.2f s")
    val pixels = of.sampled.pixels.toDouble
    var last = (0, cpu())
    def passed(done: Int): Unit =
      val now = cpu()
      if done <= 0 then println(f"# waves from ${-done} samples, $now%.2f s on")
      else
        val (before, then0) = last
        if now - then0 > 0.5 || done == samples then
          val rate = (now - then0) / ((done - before) * pixels) * 1e6
          println(f"$by\t$done\t$now%.2f\t$rate%.3f")
          last = (done, now)
        if now > seconds then throw Enough()
    val rendering = WaveRendering(of, waveSamples)
    try
      if by == "scalar" then rendering.scalar(passed): Unit
      else rendering.waves(passed, atOnce = false): Unit
    catch case _: Enough => ()
    for w <- rendering.worker do
      val paths = w.paths.toDouble
      def per(nanos: Long) = nanos / paths * 1e-3
      println(
        f"# µs a path: camera ${per(w.cameraNanos)}%.3f, closest ${per(w.wave.closestNanos)}%.3f, " +
          f"shadow ${per(w.wave.shadowNanos)}%.3f, vertices ${per(w.wave.vertexNanos)}%.3f, " +
          f"in lanes ${per(w.wave.diffuseNanos)}%.3f, " +
          f"film ${per(w.filmNanos)}%.3f; rays ${w.wave.raysTraced / paths}%.2f, " +
          f"alone ${w.wave.singles / paths}%.2f; vertices in lanes " +
          f"${w.wave.inLanes / paths}%.2f, others ${w.wave.others / paths}%.2f"
      )

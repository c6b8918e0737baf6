package candela.cli.rendering

import candela.cli.options.CommandLine
import candela.job.{ErrorRecorder, Goal, SceneLoader}
import candela.render.{Progress, RenderListener, Renderer}

import java.time.Duration

/** Renders scenes, and tells how far off the time left, and the samples at which a goal ends the
  * rendering, were at parts of the time.
  *
  * Usage: `./sbt "Test/runMain candela.cli.rendering.TimeLeftTable scene.pbrt --error 2%"`: the
  * words of a command line, once for each scene, divided by `;`. How much of the processors each
  * rendering had is told beside: where that is much less than all, others were using them.
  */
object TimeLeftTable:
  private val Parts = Vector(0.1, 0.25, 0.5, 0.75)

  /** What was told at a part of the time, relative to what came.
    *
    * @param time    the whole time, if it was told or is expected within an interval, less one
    * @param times   interval of the whole time, if that was told instead
    * @param spp     samples per pixel, less one
    * @param samples their interval
    */
  private final case class Told(
      time: Option[Double],
      times: Option[(Double, Double)],
      spp: Option[Double],
      samples: Option[(Double, Double)]
  ):
    override def toString: String =
      def range(r: (Double, Double)) =
        s"${f"${r._1}%.2f"} to ${f"${r._2}%.2f"}${if holds(r) then "" else " (!)"}"
      val ofTime = time.fold("–")(shown) + times.fold("")(r => s", ${range(r)}")
      val ofSamples = spp.fold("")(s => s"; ${shown(s)}, ${range(samples.get)}")
      ofTime + ofSamples

  private def shown(x: Double) = f"${100 * x}%+.0f %%"
  private def holds(r: (Double, Double)) = r._1 <= 1 && r._2 >= 1

  def main(args: Array[String]): Unit =
    println("At parts of the time: the whole time, or its interval; samples per pixel, interval.\n")
    val parts = Parts.map(shown).mkString(" | ")
    println(s"| command | seconds | of the threads' time | samples | $parts |")
    println(s"|---|---|---|---|${Parts.map(_ => "---|").mkString}")
    val rows = args.mkString(" ").split(";").toVector.map(_.trim.split(" +").toVector).map: words =>
      val (pixels, had, looks) = rendered(words)
      val (end, samples) = (looks.last.seconds, looks.last.done / pixels)
      val all = Parts.map(part => told(looks.find(_.seconds >= part * end).get, end, samples))
      val name = words.map(w => w.split('/').takeRight(2).mkString("/")).mkString(" ")
      println(f"| $name | $end%.1f | ${100 * had}%.0f %% | $samples%.0f | ${all.mkString(" | ")} |")
      all
    println(
      "\n| at | time or interval | expected time within 15 % | time alone | within 15 % | " +
        "interval | holds | samples | within 15 % | interval holds |"
    )
    println(s"|---|${"---|" * 9}")
    for (part, i) <- Parts.zipWithIndex do
      val all = rows.map(_(i))
      def near(x: Vector[Double]) = x.count(Math.abs(_) <= 0.15)
      val (times, ranges) = (all.flatMap(_.time), all.flatMap(_.times))
      val alone = all.filter(_.times.isEmpty).flatMap(_.time)
      val (spp, samples) = (all.flatMap(_.spp), all.flatMap(_.samples))
      println(
        s"| ${shown(part)} | ${times.size} of ${all.size} | ${near(times)} | ${alone.size} | " +
          s"${near(alone)} | ${ranges.size} | ${ranges.count(holds)} | ${spp.size} | " +
          s"${near(spp)} | ${samples.count(holds)} |"
      )

  private def told(look: Progress, end: Double, samples: Double): Told =
    val o = look.outlook
    Told(
      o.left.orElse(o.between.map(_.expected)).map(l => (look.seconds + l) / end - 1),
      o.between.map(r => ((look.seconds + r.low) / end, (look.seconds + r.high) / end)),
      o.samples.map(_.expected / samples - 1),
      o.samples.map(s => (s.low / samples, s.high / samples))
    )

  /** The pixels that samples are taken for, the part that the rendering had of the time of its
    * threads, and all looks at the progress.
    */
  private def rendered(words: Vector[String]): (Double, Double, Vector[Progress]) =
    val options = CommandLine.parse(words)
      .getOrElse(throw IllegalArgumentException(words.mkString(" ")))
    val plan = SceneLoader.FromFile.load(options.files.head, options.preparation).plan
    val looks = Vector.newBuilder[Progress]
    val goal = Option.when(options.settings.goal.isGiven):
      Goal(options.settings.goal, plan.samplesPerPixel, ErrorRecorder(plan.development, None))
    val (began, before) = (System.nanoTime, processor)
    val _ = Renderer.render(
      plan,
      options.threadCount,
      listener = RenderListener.all(goal ++ Some(RenderListener.onProgress(p => looks += p: Unit)))
    )
    val had = (processor - before) / (System.nanoTime - began) / options.threadCount
    (plan.sampled.pixels.toDouble, had, looks.result())

  /** Nanoseconds of processor time of this process. */
  private def processor: Double =
    ProcessHandle.current.info.totalCpuDuration.orElse(Duration.ZERO).toNanos.toDouble

package candela.cli.rendering

import candela.cli.options.CommandLine
import candela.job.{ErrorRecorder, Goal, SceneLoader}
import candela.render.{Progress, RenderListener, Renderer}

/** Renders scenes, and tells how far off the time left, and the samples at which a goal ends the
  * rendering, were at parts of the time.
  *
  * Usage: `./sbt "Test/runMain candela.cli.rendering.TimeLeftTable scene.pbrt --error 2%"`: the
  * words of a command line, once for each scene, divided by `;`.
  */
object TimeLeftTable:
  private val Parts = Vector(0.1, 0.25, 0.5, 0.75)

  /** What was told at a part of the time, relative to what came.
    *
    * @param time    the whole time, if it was told, less one
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
      val ofTime = time.map(shown).orElse(times.map(range)).getOrElse("–")
      val ofSamples = spp.fold("")(s => s"; ${shown(s)}, ${range(samples.get)}")
      ofTime + ofSamples

  private def shown(x: Double) = f"${100 * x}%+.0f %%"
  private def holds(r: (Double, Double)) = r._1 <= 1 && r._2 >= 1

  def main(args: Array[String]): Unit =
    println("At parts of the time: the whole time, or its interval; samples per pixel, interval.\n")
    println(s"| command | seconds | samples | ${Parts.map(shown).mkString(" | ")} |")
    println(s"|---|---|---|${Parts.map(_ => "---|").mkString}")
    val rows = args.mkString(" ").split(";").toVector.map(_.trim.split(" +").toVector).map: words =>
      val (pixels, looks) = rendered(words)
      val (end, samples) = (looks.last.seconds, looks.last.done / pixels)
      val all = Parts.map(part => told(looks.find(_.seconds >= part * end).get, end, samples))
      val name = words.map(w => w.split('/').takeRight(2).mkString("/")).mkString(" ")
      println(f"| $name | $end%.1f | $samples%.0f | ${all.mkString(" | ")} |")
      all
    println(
      "\n| at | time told | within 15 % | interval told | holds | samples within 15 % | hold |"
    )
    println("|---|---|---|---|---|---|---|")
    for (part, i) <- Parts.zipWithIndex do
      val all = rows.map(_(i))
      def near(x: Vector[Double]) = x.count(Math.abs(_) <= 0.15)
      val (times, ranges) = (all.flatMap(_.time), all.flatMap(_.times))
      val (spp, samples) = (all.flatMap(_.spp), all.flatMap(_.samples))
      println(
        s"| ${shown(part)} | ${times.size} of ${all.size} | ${near(times)} | ${ranges.size} | " +
          s"${ranges.count(holds)} | ${near(spp)} of ${spp.size} | ${samples.count(holds)} |"
      )

  private def told(look: Progress, end: Double, samples: Double): Told =
    val o = look.outlook
    Told(
      o.left.map(l => (look.seconds + l) / end - 1),
      o.between.map(r => ((look.seconds + r.low) / end, (look.seconds + r.high) / end)),
      o.samples.map(_.expected / samples - 1),
      o.samples.map(s => (s.low / samples, s.high / samples))
    )

  /** The pixels that samples are taken for, and all looks at the progress. */
  private def rendered(words: Vector[String]): (Double, Vector[Progress]) =
    val options = CommandLine.parse(words)
      .getOrElse(throw IllegalArgumentException(words.mkString(" ")))
    val plan = SceneLoader.FromFile.load(options.files.head, options.preparation).plan
    val looks = Vector.newBuilder[Progress]
    val goal = Option.when(options.settings.goal.isGiven):
      Goal(options.settings.goal, plan.samplesPerPixel, ErrorRecorder(plan.development, None))
    val _ = Renderer.render(
      plan,
      options.threadCount,
      listener = RenderListener.all(goal ++ Some(RenderListener.onProgress(p => looks += p: Unit)))
    )
    (plan.sampled.pixels.toDouble, looks.result())

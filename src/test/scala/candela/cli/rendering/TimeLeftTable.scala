package candela.cli.rendering

import candela.cli.options.CommandLine
import candela.job.{ErrorRecorder, Goal, SceneLoader}
import candela.render.{Progress, RenderListener, Renderer}

/** Renders scenes, and tells how far off the time left was at a part of the time.
  *
  * Usage: `./sbt "Test/runMain candela.cli.rendering.TimeLeftTable scene.pbrt --spp 64"`: the words
  * of a command line, once for each scene, divided by `,`.
  */
object TimeLeftTable:
  private val Parts = Vector(0.1, 0.25, 0.5, 0.75)

  def main(args: Array[String]): Unit =
    println(s"| command | seconds | ${Parts.map(p => f"${100 * p}%.0f %%").mkString(" | ")} |")
    println(s"|---|---|${Parts.map(_ => "---|").mkString}")
    for words <- args.mkString(" ").split(",").map(_.trim.split(" +").toVector) do
      val looks = rendered(words)
      val total = looks.last.seconds
      def off(part: Double): String =
        val look = looks.find(_.seconds >= part * total).get
        val now = look.outlook.left.map(l => (look.seconds + l) / total - 1)
        val plain = look.seconds * look.total / Math.max(1, look.done) / total - 1
        def shown(x: Double) = f"${100 * x}%+.0f %%"
        s"${now.fold("–")(shown)} (${shown(plain)})"
      val name = words.map(w => w.split('/').takeRight(2).mkString("/")).mkString(" ")
      println(f"| $name | $total%.1f | ${Parts.map(off).mkString(" | ")} |")

  private def rendered(words: Vector[String]): Vector[Progress] =
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
    looks.result()

package candela.render

import candela.cli.options.CommandLine
import candela.film.Film
import candela.job.{ErrorRecorder, Goal, SceneLoader}

/** Compares what a rendering with `--error` tells in its course with what comes true, for
  * docs/NOISE.md: one rendering, in which many errors are asked for.
  *
  * Arguments: those of a rendering, with `--time`: how long it takes, in seconds. Errors that are
  * reached in the last `--last` of this time count, half of it by default.
  */
object TimeLeftTable:
  private val Parts = Vector(0.1, 0.25, 0.5, 0.75)

  /** Errors that are asked for: each so much smaller than the one before. */
  private val Finer = 0.95
  private val Errors = 140

  /** How near what is told is to be. */
  private val Near = 0.15

  def main(args: Array[String]): Unit =
    val at = args.indexOf("--last")
    val last = if at < 0 then 0.5 else args(at + 1).toDouble
    val words = if at < 0 then args else args.patch(at, Nil, 2)
    val options = CommandLine.parse(words.toVector).fold(e => sys.error(e.toString), identity)
    val seconds = options.settings.goal.time.getOrElse(sys.error("--time is missing"))
    val plan = SceneLoader.FromFile.load(options.files.head, options.preparation).plan
    val schedule = Job(plan, Shard.Whole).schedule
    val pixels = plan.sampled.pixels.toDouble
    def forecast(by: RenderListener) = Forecast(schedule, pixels, 0, options.threadCount, by)
    val asked = Vector.tabulate(Errors)(k => Asked(Math.pow(Finer, k), pixels, forecast))
    val course = Course(plan, seconds, asked)
    val _ = Renderer.render(plan, options.threadCount, listener = course)
    val found = asked.flatMap(_.outcome).distinctBy(_.samples)
      .filter(o => o.seconds >= seconds * (1 - last))
    println(s"${options.files.head}: ${found.size} errors are reached, after " +
      found.map(o => f"${o.seconds}%.0f").mkString(", ") + " s")
    println("| at | samples told | within 15 % | interval holds | time told | within 15 % | " +
      "interval told | holds |")
    println("|---|---|---|---|---|---|---|---|")
    for part <- Parts do
      val told = found.flatMap(o => o.told(part).map(_ -> o))
      val samples = told.flatMap((t, o) => t.samples.map(_ -> o))
      val times = told.flatMap((t, o) => t.left.map(l => (t.seconds + l) / o.seconds))
      val ranges = told.flatMap((t, o) => t.between.map((_, t.seconds, o)))
      def near(ratio: Double) = Math.abs(ratio - 1) <= Near
      val cells = Vector(
        samples.size,
        samples.count((s, o) => near(s.expected.toDouble / o.samples)),
        samples.count((s, o) => s.low <= o.samples && o.samples <= s.high),
        times.size,
        times.count(near),
        ranges.size,
        ranges.count((r, t, o) => t + r.low <= o.seconds && o.seconds <= t + r.high)
      )
      println(s"| ${(100 * part).round} % of ${found.size} | ${cells.mkString(" | ")} |")
    println("What was expected over what came true, samples and the whole time:")
    for part <- Parts do
      val ratios =
        for
          o <- found
          t <- o.told(part)
          s <- t.samples
        yield
          val time = t.left.orElse(t.between.map(_.expected)).map(l => (t.seconds + l) / o.seconds)
          f"${s.expected / o.samples}%.2f ${time.fold("-")(r => f"$r%.2f")}"
      println(s"${(100 * part).round} %: ${ratios.mkString(", ")}")

  /** What is told at a time. */
  private final case class Told(
      seconds: Double,
      samples: Option[SampleRange],
      left: Option[Double],
      between: Option[TimeRange]
  )

  /** When an error was reached, and what was told until then. */
  private final case class Outcome(samples: Double, seconds: Double, course: Vector[Told]):
    def told(part: Double): Option[Told] = course.takeWhile(_.seconds <= part * seconds).lastOption

  /** An error that is asked for; the rendering goes on when it is reached. */
  private final class Asked(error: Double, pixels: Double, make: RenderListener => Forecast):
    private var expected = Option.empty[SampleRange]

    /** Samples at which it ends, by the last look; and where that is certain. */
    private var last, end = Option.empty[Int]
    private var course = Vector.empty[Told]
    private var before = (0.0, 0.0)
    var outcome: Option[Outcome] = None

    private val forecast = make:
      new RenderListener:
        override def goal: Option[ExpectedEnd] = Some(ExpectedEnd(None, true, expected))

    /** As [[Goal]] does at each look: ends at the samples that were found, if those come before the
      * next look.
      */
    def looked(recorder: ErrorRecorder, samples: Int): Unit = if outcome.isEmpty && end.isEmpty then
      val found = recorder.samplesUntil(error)
      expected = found.flatMap(Goal.range)
      last = found.map(f => Goal.whole(f.estimate))
      if last.exists(_ <= samples) then end = Some(Math.max(Goal.Fewest, samples))

    def progressed(p: Progress): Unit = if outcome.isEmpty then
      val samples = p.done / pixels
      for n <- end.orElse(last) if n <= samples do
        val (s, t) = before
        val part = if samples > s then Math.max(0, (n - s) / (samples - s)) else 1
        outcome = Some(Outcome(n, t + part * (p.seconds - t), course))
      before = (samples, p.seconds)
      val o = forecast.outlook(p.done, RenderPlan.Endless, p.seconds, p.seconds)
      course :+= Told(p.seconds, o.samples, o.left, o.between)

  private final class Course(plan: RenderPlan, seconds: Double, asked: Vector[Asked])
      extends RenderListener:
    private val recorder = ErrorRecorder(plan.development, None)
    private var isLate = false
    override def looks: Looks = Looks.Waves
    override def passed(pass: Pass, film: Film): Unit =
      recorder.passed(pass, film)
      asked.foreach(_.looked(recorder, pass.samples))
      isLate = pass.end >= seconds
    override def isEnough: Boolean = isLate
    override def progressed(p: Progress): Unit = asked.foreach(_.progressed(p))

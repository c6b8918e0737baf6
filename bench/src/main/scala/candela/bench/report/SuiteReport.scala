package candela.bench.report

import candela.bench.statistics.{MeasuredCurve, MeasuredPoint}
import candela.image.Image
import candela.measure.{BiasRegion, BiasTest, Interval, Metric, OwnError}
import candela.report.{Machine, Numbers, RenderData}

/** Results of one program on one scene.
  *
  * @param command command line of the first image
  * @param isThin whether its curve is dashed, beside another program of the same colour
  * @param picture image of the longest run with the first seed
  * @param firstImage seconds until it has written an image of one sample per pixel, a median
  * @param otherShare share of the processors that other programs took during its runs, if known
  */
final case class ProgramResult(
    name: String,
    title: String,
    color: Int,
    isThin: Boolean,
    command: String,
    curve: MeasuredCurve,
    picture: Image,
    firstImage: Option[Double] = None,
    otherShare: Option[Double] = None
):
  def isDisturbed: Boolean = otherShare.exists(_ >= ProgramResult.Disturbing)

object ProgramResult:
  /** Share of the processors whose loss is worth a warning. */
  private val Disturbing = 0.05

/** Whether a program has the same expected image as another one. */
final case class BiasAgainst(program: String, other: String, test: BiasTest)

/** Results of all programs on one scene, against the named reference, or of seeds against each
  * other: the reference is then the mean of the longest renderings of some programs.
  *
  * @param target the relative MSE to reach
  * @param makers titles of these programs
  * @param biases tests of the programs against the first one, where there are some seeds
  * @param growth what it has more of than other scenes
  */
final case class SceneResult(
    name: String,
    title: String,
    note: String,
    reference: Image,
    referenceName: Option[String],
    target: Double,
    programs: Vector[ProgramResult],
    makers: Vector[String] = Vector.empty,
    biases: Vector[BiasAgainst] = Vector.empty,
    growth: Option[Growth] = None
):
  /** The reference's own error, which is subtracted, if it is known. */
  def ownError: Option[OwnError] =
    programs.flatMap(_.curve.points.flatMap(_.runs.flatMap(_.errors.own))).headOption

  /** The longest time, in seconds, for which all programs' errors are known. */
  val equalTime: Option[Double] =
    val spans = programs.flatMap(_.curve.span)
    val latestStart = spans.map(_._1).maxOption
    spans.map(_._2).minOption.filter(end => latestStart.exists(_ <= end))

  def errorAtEqualTime(p: ProgramResult): Option[Double] = equalTime.flatMap(p.curve.errorAt)

/** Results of a suite.
  *
  * @param begun date and time of the start
  * @param seconds total time of all runs
  * @param leftOut what was not run: (program or scene, reason)
  */
final case class SuiteReport(
    title: String,
    version: String,
    machine: Machine,
    begun: String,
    seconds: Double,
    seeds: Int,
    scenes: Vector[SceneResult],
    leftOut: Vector[(String, String)]
):
  /** The scenes that grow, by what they have more of. */
  def growing: Vector[GrowingScenes] = GrowingScenes.of(scenes)

  /** What the load at the start tells. It may be that of what had just ended: where the share of
    * other programs is known of all runs, that tells.
    */
  def business: Option[String] =
    machine.business.filter(_ => scenes.exists(_.programs.exists(_.otherShare.isEmpty)))

  /** Where other programs took much of the machine, in words. */
  def disturbances: Vector[String] = scenes.flatMap: s =>
    val shares =
      for p <- s.programs if p.isDisturbed; share <- p.otherShare
      yield s"${Numbers.percentage(share)} while ${p.title} ran"
    Option.when(shares.nonEmpty):
      s"on ${s.title}, other programs took much of the processors: ${shares.mkString(", ")}; " +
        "times are too long"

/** Machine-readable results: JSON with all runs, and CSV with one line per run. */
object SuiteData:
  /** Of the JSON: docs/bench/results.schema.json describes it. Higher where fields that were there
    * mean something else.
    */
  val SchemaVersion = 1

  def json(r: SuiteReport): String =
    val report = ujson.Obj(
      "schemaVersion" -> SchemaVersion,
      "title" -> r.title,
      "version" -> r.version,
      "begun" -> r.begun,
      "seconds" -> r.seconds,
      "seeds" -> r.seeds,
      "machine" -> RenderData.machine(r.machine),
      "scenes" -> ujson.Arr.from(r.scenes.map(scene)),
      "leftOut" -> ujson.Arr.from(r.leftOut.map((what, why) => ujson.Arr(what, why)))
    )
    ujson.write(report, indent = 2) + "\n"

  def csv(r: SuiteReport): String =
    val head = "scene,program,samples,seed,seconds,memory,relmse,mse,mae,psnr,flip"
    val rows =
      for
        s <- r.scenes
        p <- s.programs
        point <- p.curve.points
        run <- point.runs
      yield
        val figures = Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae, Metric.Psnr, Metric.Flip)
          .map(m => run.errors(m).fold("")(_.toString))
        val memory = run.memory.fold("")(_.toString)
        (Vector(s.name, p.name, run.samples, run.seed, run.seconds, memory) ++ figures)
          .mkString(",")
    (head +: rows).map(_ + "\n").mkString

  private def scene(s: SceneResult): ujson.Obj = ujson.Obj(
    "name" -> s.name,
    "title" -> s.title,
    "note" -> s.note,
    "reference" -> s.referenceName.fold(ujson.Null: ujson.Value)(ujson.Str(_)),
    "referenceError" -> RenderData.ownError(s.ownError),
    "makers" -> ujson.Arr.from(s.makers),
    "grows" -> s.growth.fold(ujson.Null: ujson.Value)(g =>
      ujson.Obj("of" -> g.quantity, "size" -> RenderData.number(g.size))
    ),
    "biases" -> ujson.Arr.from(s.biases.map(bias)),
    "target" -> RenderData.number(s.target),
    "equalTime" -> s.equalTime.fold(ujson.Null: ujson.Value)(RenderData.number),
    "programs" -> ujson.Arr.from(s.programs.map(program(s, _)))
  )

  private def bias(b: BiasAgainst): ujson.Obj = ujson.Obj(
    "program" -> b.program,
    "other" -> b.other,
    "p" -> RenderData.number(b.test.p),
    "wholeImage" -> ujson.Arr.from(b.test.fullImage.map(region)),
    "mostDifferent" -> ujson.Arr.from(b.test.worst.map(region))
  )

  private def region(r: BiasRegion): ujson.Obj = ujson.Obj(
    "x0" -> r.window.x0,
    "x1" -> r.window.x1,
    "y0" -> r.window.y0,
    "y1" -> r.window.y1,
    "channel" -> r.channel,
    "mean" -> RenderData.number(r.a),
    "otherMean" -> RenderData.number(r.b),
    "standardError" -> RenderData.number(r.error),
    "p" -> RenderData.number(r.adjusted)
  )

  private def program(s: SceneResult, p: ProgramResult): ujson.Obj = ujson.Obj(
    "name" -> p.name,
    "title" -> p.title,
    "command" -> p.command,
    "points" -> ujson.Arr.from(p.curve.points.map(point)),
    "slope" -> optionalInterval(p.curve.slope),
    "efficiency" -> optionalInterval(p.curve.efficiency),
    "firstImage" -> p.firstImage.fold(ujson.Null: ujson.Value)(RenderData.number),
    "memory" -> p.curve.memory.fold(ujson.Null: ujson.Value)(m => RenderData.number(m.toDouble)),
    "others" -> p.otherShare.fold(ujson.Null: ujson.Value)(RenderData.number),
    "meanRatio" -> ujson.Arr.from(p.curve.meanRatio.map(RenderData.number)),
    "secondsToTarget" ->
      p.curve.secondsUntil(s.target).fold(ujson.Null: ujson.Value)(i =>
        RenderData.number(i.estimate)
      ),
    "secondsToTargetInterval" -> optionalInterval(p.curve.secondsUntil(s.target)),
    "errorAtEqualTime" ->
      s.errorAtEqualTime(p).fold(ujson.Null: ujson.Value)(RenderData.number)
  )

  private def point(p: MeasuredPoint): ujson.Obj = ujson.Obj(
    "samples" -> p.samples,
    "seconds" -> p.seconds,
    "relmse" -> optionalInterval(p(Metric.RelativeMse)),
    "mse" -> optionalInterval(p(Metric.Mse)),
    "flip" -> optionalInterval(p(Metric.Flip)),
    "deviation" -> number(p.deviation(Metric.RelativeMse)),
    "worstPixels" -> number(p.worst),
    "spectrum" -> ujson.Arr.from(p.spectrum.map: band =>
      ujson.Obj(
        "frequency" -> RenderData.number(band.frequency),
        "power" -> RenderData.number(band.power),
        "deviation" -> RenderData.number(band.deviation)
      )),
    "runs" -> ujson.Arr.from(p.runs.map: run =>
      ujson.Obj(
        "seed" -> run.seed,
        "seconds" -> run.seconds,
        "memory" -> run.memory.fold(ujson.Null: ujson.Value)(m => RenderData.number(m.toDouble)),
        "relmse" -> RenderData.number(run.errors.relativeMse),
        "mse" -> number(run.errors(Metric.Mse)),
        "flip" -> number(run.errors(Metric.Flip)),
        "meanRatio" -> ujson.Arr.from(run.errors.meanRatio.map(RenderData.number))
      ))
  )

  private def number(figure: Option[Double]): ujson.Value =
    figure.fold(ujson.Null: ujson.Value)(RenderData.number)

  private def optionalInterval(interval: Option[Interval]): ujson.Value =
    interval.fold(ujson.Null: ujson.Value): i =>
      ujson.Obj(
        "estimate" -> RenderData.number(i.estimate),
        "low" -> RenderData.number(i.low),
        "high" -> RenderData.number(i.high)
      )

package candela.report

import candela.image.Image
import candela.measure.{CurvePoint, OwnError}

/** A time span, in seconds since the program started. */
final case class Span(name: String, begin: Double, end: Double):
  def seconds: Double = end - begin

/** An image shown by a page.
  *
  * @param isReference whether the other images are compared with it
  */
final case class Picture(name: String, image: Image, isReference: Boolean = false)

/** A figure that tells what a rendering's paths learnt.
  *
  * @param key  its name in JSON
  * @param what its name for readers
  * @param text the value for readers
  */
final case class LearnedFigure(key: String, what: String, value: Double, text: String)

/** What a part of a rendering takes: bytes of memory, estimated, and seconds. */
final case class CostFigure(kind: String, bytes: Long, seconds: Double, text: String)

/** Data of the report about one rendering.
  *
  * @param options options for display: (option, value)
  * @param plan features of the scene: (feature, value)
  * @param points error after each pass; without a reference estimated, from the second pass on
  * @param passes time span of each pass, in seconds since rendering started, with each worker's
  *   busy time
  * @param learned what the paths learnt, if they did
  * @param costs what takes memory and time
  */
final case class RenderReport(
    scene: String,
    version: String,
    machine: Machine,
    options: Vector[(String, String)],
    plan: Vector[(String, String)],
    reference: Option[String],
    points: Vector[CurvePoint],
    phases: Vector[Span],
    passes: Vector[PassSpan],
    pictures: Vector[Picture],
    rays: Long,
    learned: Vector[LearnedFigure] = Vector.empty,
    costs: Vector[CostFigure] = Vector.empty
):
  /** The reference's own error, which is subtracted, if it is known. */
  def ownError: Option[OwnError] = points.lastOption.flatMap(_.errors.own)
  def width: Int = pictures.head.image.width
  def height: Int = pictures.head.image.height

/** One pass on the timeline; `workers` holds busy times in seconds. */
final case class PassSpan(samples: Int, begin: Double, end: Double, workers: Vector[Double])

/** Machine-readable report: JSON, and the error curve as CSV. */
object RenderData:

  def json(r: RenderReport): String =
    val report = ujson.Obj(
      "program" -> "candela",
      "version" -> r.version,
      "scene" -> r.scene,
      "reference" -> r.reference.fold(ujson.Null: ujson.Value)(ujson.Str(_)),
      "referenceError" -> ownError(r.ownError),
      "estimated" -> r.reference.isEmpty,
      "width" -> r.width,
      "height" -> r.height,
      "rays" -> r.rays.toDouble,
      "options" -> pairs(r.options),
      "plan" -> pairs(r.plan),
      "machine" -> machine(r.machine),
      "costs" -> ujson.Arr.from(r.costs.map: c =>
        ujson.Obj("kind" -> c.kind, "bytes" -> c.bytes.toDouble, "seconds" -> c.seconds)),
      "phases" -> ujson.Arr.from(
        r.phases.map(s => ujson.Obj("name" -> s.name, "begin" -> s.begin, "end" -> s.end))
      ),
      "passes" -> ujson.Arr.from(r.passes.map(pass)),
      "points" -> ujson.Arr.from(r.points.map(point))
    )
    if r.learned.nonEmpty then
      report("guiding") = ujson.Obj.from(r.learned.map(f => f.key -> number(f.value)))
    ujson.write(report, indent = 2) + "\n"

  def csv(r: RenderReport): String =
    val head = "samples,seconds,mse,relmse,mae,psnr,flip,mean_ratio_r,mean_ratio_g,mean_ratio_b," +
      "relmse_low,relmse_high"
    val rows = r.points.map: p =>
      val e = p.errors
      val ratios = e.meanRatio.map(_.toString).padTo(3, "")
      val optionalErrors = Vector(e.mae, e.psnr, e.flip).map(_.fold("")(_.toString))
      val limits = Vector(p.interval.map(_.low), p.interval.map(_.high).filter(_.isFinite))
        .map(_.fold("")(_.toString))
      (Vector(
        p.samples,
        p.seconds,
        e.mse,
        e.relativeMse
      ).map(_.toString) ++ optionalErrors ++ ratios ++
        limits)
        .mkString(",")
    (head +: rows).map(_ + "\n").mkString

  /** The own error of a reference; null if it is unknown. */
  def ownError(error: Option[OwnError]): ujson.Value = error.fold(ujson.Null: ujson.Value): o =>
    ujson.Obj("mse" -> number(o.mse), "relmse" -> number(o.relativeMse))

  def machine(m: Machine): ujson.Obj = ujson.Obj(
    "processor" -> m.processor,
    "cores" -> m.cores,
    "memoryBytes" -> m.memoryBytes.toDouble,
    "system" -> m.system,
    "java" -> m.java,
    "load" -> m.load.fold(ujson.Null: ujson.Value)(ujson.Num(_))
  )

  /** The value, or null if it isn't finite, which JSON can't represent. */
  def number(value: Double): ujson.Value =
    if java.lang.Double.isFinite(value) then ujson.Num(value) else ujson.Null

  private def pairs(rows: Vector[(String, String)]): ujson.Arr =
    ujson.Arr.from(rows.map((name, value) => ujson.Arr(name, value)))

  private def pass(p: PassSpan): ujson.Obj = ujson.Obj(
    "samples" -> p.samples,
    "begin" -> p.begin,
    "end" -> p.end,
    "workers" -> ujson.Arr.from(p.workers)
  )

  private def point(p: CurvePoint): ujson.Obj =
    val e = p.errors
    def optional(figure: Option[Double]) = figure.fold(ujson.Null: ujson.Value)(number)
    ujson.Obj(
      "samples" -> p.samples,
      "seconds" -> p.seconds,
      "mse" -> number(e.mse),
      "relmse" -> number(e.relativeMse),
      "relmseInterval" -> p.interval.fold(ujson.Null: ujson.Value): i =>
        ujson.Obj("low" -> number(i.low), "high" -> number(i.high)),
      "mae" -> optional(e.mae),
      "psnr" -> optional(e.psnr),
      "flip" -> optional(e.flip),
      "meanRatio" -> ujson.Arr.from(e.meanRatio.map(number))
    )

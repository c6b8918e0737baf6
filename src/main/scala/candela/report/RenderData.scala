package candela.report

import candela.measure.CurvePoint

/** A report for machines: JSON, and the curve alone as CSV. */
object RenderData:

  def json(r: RenderReport): String =
    val all = ujson.Obj(
      "program" -> "candela",
      "version" -> r.version,
      "scene" -> r.scene,
      "reference" -> r.reference.fold(ujson.Null: ujson.Value)(ujson.Str(_)),
      "estimated" -> r.reference.isEmpty,
      "width" -> r.width,
      "height" -> r.height,
      "rays" -> r.rays.toDouble,
      "options" -> pairs(r.options),
      "plan" -> pairs(r.plan),
      "machine" -> machine(r.machine),
      "phases" -> ujson.Arr.from(
        r.phases.map(s => ujson.Obj("name" -> s.name, "begin" -> s.begin, "end" -> s.end))
      ),
      "passes" -> ujson.Arr.from(r.passes.map(pass)),
      "points" -> ujson.Arr.from(r.points.map(point))
    )
    ujson.write(all, indent = 2) + "\n"

  def csv(r: RenderReport): String =
    val head = "samples,seconds,mse,relmse,mae,psnr,flip,mean_ratio_r,mean_ratio_g,mean_ratio_b"
    val rows = r.points.map: p =>
      val e = p.errors
      val ratios = e.meanRatio.map(_.toString).padTo(3, "")
      val known = Vector(e.mae, e.psnr, e.flip).map(_.fold("")(_.toString))
      (Vector(p.samples, p.seconds, e.mse, e.relativeMse).map(_.toString) ++ known ++ ratios)
        .mkString(",")
    (head +: rows).map(_ + "\n").mkString

  def machine(m: Machine): ujson.Obj = ujson.Obj(
    "processor" -> m.processor,
    "cores" -> m.cores,
    "memoryBytes" -> m.memoryBytes.toDouble,
    "system" -> m.system,
    "java" -> m.java,
    "load" -> m.load.fold(ujson.Null: ujson.Value)(ujson.Num(_))
  )

  /** JSON has no infinities: what isn't finite is null. */
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
    def known(figure: Option[Double]) = figure.fold(ujson.Null: ujson.Value)(number)
    ujson.Obj(
      "samples" -> p.samples,
      "seconds" -> p.seconds,
      "mse" -> number(e.mse),
      "relmse" -> number(e.relativeMse),
      "mae" -> known(e.mae),
      "psnr" -> known(e.psnr),
      "flip" -> known(e.flip),
      "meanRatio" -> ujson.Arr.from(e.meanRatio.map(number))
    )

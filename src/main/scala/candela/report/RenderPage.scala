package candela.report

import candela.measure.{CurvePoint, LogLogFit}

import scalatags.Text.all.*

/** Page about one rendering. */
object RenderPage:

  def html(r: RenderReport): String =
    val against = r.reference.fold("without a reference: errors are estimated from the noise"):
      name => s"compared with $name"
    val charts = ErrorCharts(r.points, isEstimated = r.reference.isEmpty)
    Page.html(s"Report: ${r.scene}", against, r.version)(
      tiles(r, charts),
      h2("Error over time"),
      charts.allCharts,
      explained(r),
      h2("Figures"),
      figures(r),
      h2("Pictures"),
      Viewer(r.pictures),
      h2("Timeline"),
      div(
        cls := "card chart",
        Page.fitting(
          Timeline(r.phases, r.passes).svg,
          Timeline(r.phases, r.passes, Timeline.Narrow).svg
        )
      ),
      p(cls := "soft", "Render time excludes the measuring of errors."),
      h2("Scene"),
      Page.facts(r.plan),
      Option.when(r.costs.nonEmpty):
        frag(h2("Memory, estimated, and time"), Page.facts(r.costs.map(c => (c.kind, c.text))))
      ,
      Option.when(r.learned.nonEmpty):
        frag(h2("What paths learnt"), Page.facts(r.learned.map(f => (f.what, f.text))))
      ,
      h2("Options and machine"),
      Page.facts(("version" -> s"Candela ${r.version}") +: (r.options ++ r.machine.rows))
    )

  private def tiles(r: RenderReport, charts: ErrorCharts): Frag =
    val finalPoint = r.points.lastOption
    val slope = LogLogFit.slope(r.points.map: p =>
      (p.samples.toDouble, Math.sqrt(p.errors.relativeMse)))
    div(
      cls := "tiles",
      finalPoint.map(p => Page.tile(error(p), charts.word("relative error"))),
      finalPoint.map(p => Page.tile(s"${Numbers.short(p.seconds)} s", "rendering")),
      finalPoint.map(p => Page.tile(p.samples.toString, "samples per pixel")),
      finalPoint.filter(p => p.errors.relativeMse > 0).map: p =>
        val efficiency = 1 / (p.errors.relativeMse * Math.max(p.seconds, 1e-9))
        Page.tile(Numbers.short(efficiency), "efficiency, 1 / (relative MSE · s)")
      ,
      slope.map(s => Page.tile(Numbers.fixed(s, 2), "slope of error against samples")),
      finalPoint.flatMap(_.errors.flip).map(f => Page.tile(Numbers.short(f), "FLIP"))
    )

  private def explained(r: RenderReport): Frag =
    val explanation =
      if r.reference.isDefined then
        "One rendering with one seed, without the variation between seeds. " +
          "`candela bench` renders several seeds and plots error bars." +
          r.ownError.fold("")(ownError => s" ${Page.subtracted(ownError, r.points.map(_.errors))}")
      else
        "Without a reference, bias is unknown, and so is light that no path has found. The " +
          "error is estimated from the difference between two halves of the samples, and how " +
          "that falls. The limits behind it hold the true one in 95 % of renderings, over scenes " +
          "of many kinds."
    p(cls := "soft", explanation)

  private def figures(r: RenderReport): Frag =
    val head = Vector(
      "samples", "seconds", "relative error", "relative MSE", "MSE", "MAE", "PSNR", "FLIP"
    ) :+
      "mean ratio R, G, B"
    Page.grid(head, r.points.map(row))

  /** The relative error, with its interval if it is estimated. */
  private def error(p: CurvePoint): String =
    def percentage(relativeMse: Double) = Numbers.short(100 * Math.sqrt(relativeMse))
    percentage(p.errors.relativeMse) + p.interval.fold(" %"): i =>
      if i.isBounded then s" % (${percentage(i.low)} to ${percentage(i.high)} %)"
      else s" % (at least ${percentage(i.low)} %)"

  private def row(p: CurvePoint): Vector[Frag] =
    val e = p.errors
    val psnr = e.psnr.map(d => if d.isInfinite then "infinite" else s"${Numbers.fixed(d, 2)} dB")
    val words = Vector(p.samples.toString, Numbers.short(p.seconds)) ++
      Vector(error(p), Numbers.short(e.relativeMse), Numbers.short(e.mse)) ++
      Vector(e.mae.map(Numbers.short), psnr, e.flip.map(Numbers.short)).map(_.getOrElse("–")) :+
      (if e.meanRatio.isEmpty then "–" else e.meanRatio.map(Numbers.fixed(_, 4)).mkString(", "))
    words.map(stringFrag)

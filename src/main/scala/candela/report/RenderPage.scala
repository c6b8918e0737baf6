package candela.report

import candela.measure.{CurvePoint, LogLogFit, Metric}

import scalatags.Text.all.*

/** Page about one rendering. */
object RenderPage:

  def html(r: RenderReport): String =
    val against = r.reference.fold("without a reference: errors are estimated from the noise"):
      name => s"compared with $name"
    Page.html(s"Report: ${r.scene}", against, r.version)(
      tiles(r),
      h2("Error over time"),
      charts(r),
      explained(r),
      h2("Figures"),
      figures(r),
      h2("Pictures"),
      Viewer(r.pictures),
      h2("Timeline"),
      div(cls := "card chart", Timeline(r.phases, r.passes).svg),
      p(cls := "soft", "Render time excludes the measuring of errors."),
      h2("Scene"),
      Page.facts(r.plan),
      h2("Options and machine"),
      Page.facts(("version" -> s"Candela ${r.version}") +: (r.options ++ r.machine.rows))
    )

  private def tiles(r: RenderReport): Frag =
    val last = r.points.lastOption
    val slope = LogLogFit.slope(r.points.map(p => (p.samples.toDouble, p.errors.relativeMse)))
    div(
      cls := "tiles",
      last.map(p => Page.tile(Numbers.short(p.errors.relativeMse), word(r, "relative MSE"))),
      last.map(p => Page.tile(s"${Numbers.short(p.seconds)} s", "rendering")),
      last.map(p => Page.tile(p.samples.toString, "samples per pixel")),
      last.filter(p => p.errors.relativeMse > 0).map: p =>
        val efficiency = 1 / (p.errors.relativeMse * Math.max(p.seconds, 1e-9))
        Page.tile(Numbers.short(efficiency), "efficiency, 1 / (relative MSE · s)")
      ,
      slope.map(s => Page.tile(Numbers.fixed(s, 2), "slope of error against samples")),
      last.flatMap(_.errors.flip).map(f => Page.tile(Numbers.short(f), "FLIP"))
    )

  private def word(r: RenderReport, metric: String): String =
    if r.reference.isDefined then metric else s"$metric, estimated"

  private def charts(r: RenderReport): Frag =
    val metrics = Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae, Metric.Flip)
      .filter(m => r.points.exists(_.errors(m).exists(_ > 0)))
    val all =
      for m <- metrics; axis <- Vector("seconds", "samples")
      yield (m.word, m.title, axis, chart(r, m, axis))
    if all.isEmpty then
      p("No error to plot: zero error, or neither a reference nor a second sample.")
    else Page.charts(all)

  private def chart(r: RenderReport, metric: Metric, axis: String): Svg.Node =
    val marks = r.points.flatMap: point =>
      point.errors(metric).map: e =>
        val x = if axis == "seconds" then point.seconds else point.samples.toDouble
        val when = s"${point.samples} samples, ${Numbers.short(point.seconds)} s"
        val tip = s"$when: ${Numbers.short(e)}"
        Mark(x, e, e, e, tip)
    val label = if axis == "seconds" then "render time (s)" else "samples per pixel"
    val series = Series("this rendering", 0, isThin = false, marks)
    val title = s"${word(r, metric.title)} over $axis"
    LogLogChart(title, label, metric.title, Vector(series), LogLogChart.guideOf(metric)).svg

  private def explained(r: RenderReport): Frag =
    val what =
      if r.reference.isDefined then
        "One rendering with one seed, without the variation between seeds. " +
          "`candela bench` renders several seeds and plots error bars."
      else
        "Without a reference, bias is unknown. The plot shows the difference between two subsets " +
          "of the samples, scaled to the noise of all of them; for low-discrepancy samplers it " +
          "overestimates the noise."
    p(cls := "soft", what)

  private def figures(r: RenderReport): Frag =
    val head = Vector("samples", "seconds", "relative MSE", "MSE", "MAE", "PSNR", "FLIP") :+
      "mean ratio R, G, B"
    Page.grid(head, r.points.map(row))

  private def row(p: CurvePoint): Vector[Frag] =
    val e = p.errors
    val psnr = e.psnr.map(d => if d.isInfinite then "infinite" else s"${Numbers.fixed(d, 2)} dB")
    val words = Vector(p.samples.toString, Numbers.short(p.seconds)) ++
      Vector(e.relativeMse, e.mse).map(Numbers.short) ++
      Vector(e.mae.map(Numbers.short), psnr, e.flip.map(Numbers.short)).map(_.getOrElse("–")) :+
      (if e.meanRatio.isEmpty then "–" else e.meanRatio.map(Numbers.fixed(_, 4)).mkString(", "))
    words.map(stringFrag)

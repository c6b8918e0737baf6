package candela.report

import candela.measure.{CurvePoint, Metric}

import scalatags.Text.all.{p, stringFrag, Frag}

/** Charts of one rendering's error, one per metric, against time and samples.
  *
  * @param isEstimated whether there is no reference
  */
private[report] final class ErrorCharts(points: Vector[CurvePoint], isEstimated: Boolean):

  /** The metric's name, marked if it is an estimate. */
  def word(metric: String): String = if isEstimated then s"$metric, estimated" else metric

  def allCharts: Frag =
    val metrics = Vector(Metric.RelativeMse, Metric.Mse, Metric.Mae, Metric.Flip)
      .filter(m => points.exists(_.errors(m).exists(_ > 0)))
    val charts =
      for m <- metrics; axis <- Vector("seconds", "samples")
      yield
        def shaped(frame: ChartFrame) = chart(m, axis, frame)
        (m.word, m.title, axis, Page.fitting(shaped(ChartFrame.Whole), shaped(ChartFrame.Narrow)))
    if charts.isEmpty then
      p("No error to plot: zero error, or neither a reference nor a second sample.")
    else Page.charts(charts)

  private def chart(metric: Metric, axis: String, frame: ChartFrame): Svg.Node =
    val marks = points.flatMap: point =>
      point.errors(metric).map: e =>
        val x = if axis == "seconds" then point.seconds else point.samples.toDouble
        val moment = s"${point.samples} samples, ${Numbers.short(point.seconds)} s"
        val tip = s"$moment: ${Numbers.short(e)}"
        Mark(x, e, e, e, tip)
    val label = if axis == "seconds" then "render time (s)" else "samples per pixel"
    val series = Series("this rendering", 0, isThin = false, marks)
    val title = s"${word(metric.title)} over $axis"
    val guide = LogLogChart.guideOf(metric)
    LogLogChart(title, label, metric.title, Vector(series), guide, frame = frame).svg

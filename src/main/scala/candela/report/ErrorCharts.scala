package candela.report

import candela.measure.{CurvePoint, Errors, Metric}

import scalatags.Text.all.{p, stringFrag, Frag}

/** Charts of one rendering's error, one per metric, against time and samples.
  *
  * @param isEstimated whether there is no reference
  */
private[report] final class ErrorCharts(points: Vector[CurvePoint], isEstimated: Boolean):

  /** The metric's name, marked if it is an estimate. */
  def word(metric: String): String = if isEstimated then s"$metric, estimated" else metric

  def allCharts: Frag =
    val metrics = ErrorCharts.All.filter(m => points.exists(p => m.of(p.errors).exists(_ > 0)))
    val charts =
      for m <- metrics; axis <- Vector("seconds", "samples")
      yield
        def shaped(frame: ChartFrame) = chart(m, axis, frame)
        (m.word, m.title, axis, Page.fitting(shaped(ChartFrame.Whole), shaped(ChartFrame.Narrow)))
    if charts.isEmpty then
      p("No error to plot: zero error, or neither a reference nor a second sample.")
    else Page.charts(charts)

  private def chart(metric: ErrorCharts.Shown, axis: String, frame: ChartFrame): Svg.Node =
    val marks = points.flatMap: point =>
      metric.of(point.errors).map: e =>
        val x = if axis == "seconds" then point.seconds else point.samples.toDouble
        val moment = s"${point.samples} samples, ${Numbers.short(point.seconds)} s"
        val tip = s"$moment: ${Numbers.short(e)}"
        Mark(x, e, e, e, tip)
    val label = if axis == "seconds" then "render time (s)" else "samples per pixel"
    val series = Series("this rendering", 0, isThin = false, marks)
    val title = s"${word(metric.title)} over $axis"
    LogLogChart(title, label, metric.title, Vector(series), metric.guide, frame = frame).svg

private object ErrorCharts:
  /** What a chart shows of the errors; `guide` is the slope of independent samples. */
  final case class Shown(
      word: String,
      title: String,
      guide: Option[Double],
      of: Errors => Option[Double]
  )

  private def plain(m: Metric) = Shown(m.word, m.title, LogLogChart.guideOf(m), _(m))

  private val All =
    Shown("error", "relative error (%)", Some(-0.5), e => Some(100 * Math.sqrt(e.relativeMse))) +:
      Vector(Metric.Mse, Metric.Mae, Metric.Flip).map(plain)

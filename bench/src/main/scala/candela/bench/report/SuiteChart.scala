package candela.bench.report

import candela.measure.Metric
import candela.report.{ChartFrame, ChartGrid, LogLogChart, Mark, Numbers, Series}

/** Charts of a suite: one per scene, and an overview. */
object SuiteChart:

  /** Standalone chart of the relative MSE against time; of scenes that grow, of time and memory. */
  def svg(r: SuiteReport): String =
    if r.growing.nonEmpty then GrowthPart.grid(r, r.growing).standalone
    else if r.scenes.sizeIs == 1 then
      errorChart(r.scenes.head, Metric.RelativeMse, "seconds").standalone
    else overview(r).standalone

  /** Small charts of all scenes; each subtitle names the winner. */
  private[report] def overview(r: SuiteReport, columns: Int = ChartGrid.Columns): ChartGrid =
    val legend = r.scenes.flatMap(_.programs).distinctBy(_.name)
      .map(p => Series(p.title, p.color, p.isThin, Vector.empty))
    val panels = r.scenes.map: s =>
      chart(s, s.title, Metric.RelativeMse, "seconds", ChartGrid.frame(winner(s)))
    ChartGrid(r.title, Words, legend, panels, columns)

  private val Words =
    "Relative MSE against total time in seconds, both logarithmic: further left is faster, " +
      "lower is better. Dashed: the target error. Dotted: the slope of independent samples."

  def errorChart(
      s: SceneResult,
      metric: Metric,
      axis: String,
      frame: ChartFrame = ChartFrame.Whole
  ): LogLogChart =
    chart(s, s"${s.title}: ${metric.title}", metric, axis, frame)

  /** The error by spatial frequency at the highest sample count, if known. */
  def spectrum(s: SceneResult, frame: ChartFrame = ChartFrame.Whole): Option[LogLogChart] =
    val curves = s.programs.map: p =>
      val marks = p.curve.points.lastOption.toVector.flatMap(_.spectrum).map: band =>
        val spread = if band.deviation.isNaN then 0 else band.deviation
        val low = Math.max(band.power - spread, band.power / 10)
        val frequency = s"${Numbers.short(band.frequency)} cycles per pixel"
        val tip = s"${p.title}: $frequency, power ${Numbers.short(band.power)}"
        Mark(band.frequency, band.power, low, band.power + spread, tip)
      Series(p.title, p.color, p.isThin, marks)
    Option.when(curves.exists(_.marks.nonEmpty)):
      val title = s"${s.title}: error by spatial frequency"
      LogLogChart(title, "cycles per pixel", "power", curves, None, frame = frame)

  private def chart(
      s: SceneResult,
      title: String,
      metric: Metric,
      axis: String,
      frame: ChartFrame
  ): LogLogChart =
    val label = if axis == "seconds" then "total time (s)" else "samples per pixel"
    val goal = Option.when(metric == Metric.RelativeMse)(s.target)
    val guide = LogLogChart.guideOf(metric)
    val curves = s.programs.map(series(_, metric, axis))
    LogLogChart(title, label, metric.title, curves, guide, goal, frame)

  private def series(p: ProgramResult, metric: Metric, axis: String): Series =
    val marks = p.curve.points.flatMap: point =>
      point(metric).map: i =>
        val x = if axis == "seconds" then point.seconds else point.samples.toDouble
        val (low, high) = if i.isKnown then (i.low, i.high) else (i.estimate, i.estimate)
        // On a logarithmic axis a bar that reaches 0 or has no upper limit is unbounded.
        val (bottom, top) = (Math.max(low, i.estimate / 10), Math.min(high, i.estimate * 10))
        val moment = s"${point.samples} samples, ${Numbers.short(point.seconds)} s"
        val figure = Numbers.range(i)
        Mark(x, i.estimate, bottom, top, s"${p.title}: $moment, ${metric.title} $figure")
    Series(p.title, p.color, p.isThin, marks)

  /** The first program to reach the scene's target, and the next one's time. */
  private def winner(s: SceneResult): String =
    val times = s.programs.filterNot(_.isThin)
      .flatMap(p => p.curve.secondsUntil(s.target).map(p.title -> _.estimate)).sortBy(_._2)
    def seconds(t: Double) = s"${Numbers.fixed(t, if t < 9.95 then 1 else 0)} s"
    val goal = Numbers.tick(s.target)
    times.headOption match
      case None => s"$goal was not reached"
      case Some((name, t)) =>
        val runnerUp = times.lift(1).fold("")((_, later) => s" (next ${seconds(later)})")
        s"$goal first: $name, ${seconds(t)}$runnerUp"

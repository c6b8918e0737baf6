package candela.report

import candela.measure.Metric

import scalatags.Text.all.{frag, stringFrag, Frag}

/** Data point of a curve, with its error bar.
  *
  * @param tip tooltip
  */
final case class Mark(x: Double, y: Double, low: Double, high: Double, tip: String)

/** A curve.
  *
  * @param color colour index, from 0
  * @param isThin dashed: a variant of another curve of the same colour
  */
final case class Series(name: String, color: Int, isThin: Boolean, marks: Vector[Mark])

/** Log-log line chart in SVG: embedded in a page or, with `standalone`, as a file that follows the
  * reader's light or dark theme.
  *
  * No charting library: those either draw on a canvas, which a README can't embed, or produce
  * images with colours for only one of the themes.
  *
  * @param guideSlope expected slope, drawn as a dotted line
  * @param goal target value, drawn as a horizontal line
  * @param frame size and labels
  */
final class LogLogChart(
    title: String,
    xLabel: String,
    yLabel: String,
    series: Vector[Series],
    guideSlope: Option[Double],
    goal: Option[Double] = None,
    frame: ChartFrame = ChartFrame.Whole
):
  import LogLogChart.*
  import Svg.*

  private val LeftMargin = if frame.isWhole then 70.0 else 46.0
  private val Top = if frame.isWhole then 36.0 else 50.0
  private val drawn = series.map(s => s.copy(marks = s.marks.filter(m => m.x > 0 && m.y > 0)))
  private val marks = drawn.flatMap(_.marks)
  private val width = frame.width
  private val isNarrow = width < 500
  private val minError = marks.map(_.y).minOption.getOrElse(1.0)

  /** The target, if it is within the chart and not below all curves. */
  private val shownGoal =
    val yAxis = LogAxis.covering(marks.flatMap(m => Vector(m.y, m.low, m.high)), 1, 0)
    goal.filter(g => yAxis.pixel(g) >= 0 && yAxis.pixel(g) <= yAxis.pixel(minError) + 0.003)

  private val guideLine = guideEnds
  private val guideEntries =
    guideSlope.filter(_ => guideLine.isDefined).map: slope =>
      val number = Numbers.fixed(slope, 1).stripSuffix(".0").replace('-', '−')
      s"independent samples, slope $number" -> "guideline"
    .toVector ++ shownGoal.map(_ => "target error" -> "goalline")

  private val legend =
    Option.when(frame.isWhole)(
      ChartLegend(series, guideEntries, 3, width - LeftMargin - RightMargin)
    )
  private val bottom = frame.height - legend.fold(BareBottom)(_.height + 52)
  private val x = LogAxis.covering(marks.map(_.x), LeftMargin, width - RightMargin)
  private val y =
    LogAxis.covering(marks.flatMap(m => Vector(m.y, m.low, m.high)), bottom, Top)

  def svg: Node = picture(width, frame.height, title)(content*)

  def standalone: String = Svg.standalone(width, frame.height, title)(content)

  /** The contents without the svg element. */
  def content: Vector[Frag] =
    val titleLeft = if isNarrow && frame.isWhole then 8.0 else LeftMargin
    val words = text(titleLeft, 22, "charttitle", "start")(title) +:
      frame.note.map(text(LeftMargin, 39, "note", "start")(_)).toVector
    grid ++ goalLine ++ guide ++ drawn.map(curve) ++
      legend.toVector.flatMap(_.entries(LeftMargin, bottom + 54)) ++ words

  private def goalLine: Vector[Frag] =
    shownGoal.toVector.map: g =>
      element("g", "class" -> "goal")(
        line(LeftMargin, y.pixel(g), width - RightMargin, y.pixel(g), "goalline"),
        tip(s"target: ${Numbers.short(g)}")
      )

  private def grid: Vector[Frag] =
    val vertical = x.ticks.flatMap: value =>
      Vector(
        line(x.pixel(value), Top, x.pixel(value), bottom, "grid"),
        text(x.pixel(value), bottom + 16, "tick", "middle")(Numbers.tick(value))
      )
    val horizontal = y.ticks.flatMap: value =>
      Vector(
        line(LeftMargin, y.pixel(value), width - RightMargin, y.pixel(value), "grid"),
        text(LeftMargin - 8, y.pixel(value) + 4, "tick", "end")(Numbers.tick(value))
      )
    vertical ++ horizontal ++ (if frame.isWhole then labels else Vector.empty)

  private def labels: Vector[Frag] =
    Vector(
      text((LeftMargin + width - RightMargin) / 2, bottom + 34, "axis", "middle")(xLabel),
      element(
        "text",
        "transform" -> s"translate(16 ${px((Top + bottom) / 2)}) rotate(-90)",
        "class" -> "axis",
        "text-anchor" -> "middle"
      )(stringFrag(yLabel))
    )

  /** From the first point to the border of the chart, as points (x, y). */
  private def guideEnds: Option[((Double, Double), (Double, Double))] =
    for
      slope <- guideSlope
      from <- drawn.flatMap(_.marks.headOption).minByOption(_.x)
      lowest = marks.map(m => Math.min(m.y, m.low)).min
      lastX = Math.min(marks.map(_.x).max, from.x * Math.pow(lowest / from.y, 1 / slope))
      if lastX > from.x * 1.01
    yield ((from.x, from.y), (lastX, from.y * Math.pow(lastX / from.x, slope)))

  private def guide: Vector[Frag] =
    guideLine.toVector.zip(guideSlope).map:
      case (((x0, y0), (x1, y1)), slope) =>
        element("g", "class" -> "guide")(
          line(x.pixel(x0), y.pixel(y0), x.pixel(x1), y.pixel(y1), "guideline"),
          tip(s"slope ${Numbers.fixed(slope, 1)}: convergence of independent samples")
        )

  private def curve(s: Series): Frag =
    val css = cssOf(s)
    val path = s.marks.map(m => s"${px(x.pixel(m.x))},${px(y.pixel(m.y))}").mkString(" ")
    val bars =
      for m <- s.marks if m.low > 0 && m.high > m.low * 1.001
      yield line(x.pixel(m.x), y.pixel(m.low), x.pixel(m.x), y.pixel(m.high), "bar")
    val dots = s.marks.map: m =>
      element("circle", "cx" -> px(x.pixel(m.x)), "cy" -> px(y.pixel(m.y)), "r" -> "4")(tip(m.tip))
    element("g", "class" -> css, "data-series" -> s.name)(
      frag((element("polyline", "points" -> path)() +: (bars ++ dots))*)
    )

object LogLogChart:
  private val RightMargin = 20.0

  /** Bottom margin of a chart with ticks only. */
  private val BareBottom = 24.0

  /** −1 for squared errors, half the error for twice the work; unknown for FLIP. */
  def guideOf(metric: Metric): Option[Double] = metric match
    case Metric.Mse | Metric.RelativeMse => Some(-1.0)
    case Metric.Rmse | Metric.Mae => Some(-0.5)
    case Metric.Psnr | Metric.Flip => None

  /** Number of colours in the style sheet. */
  val Colors = 8

  /** CSS class of a curve and its legend entry. */
  def cssOf(s: Series): String = s"series c${s.color % Colors}${if s.isThin then " thin" else ""}"

package candela.report

import candela.measure.Metric

import scalatags.Text.all.{frag, stringFrag, Frag}

/** A place on a curve, and its error bar.
  *
  * @param tip what is shown while the mouse rests there
  */
final case class Mark(x: Double, y: Double, low: Double, high: Double, tip: String)

/** A curve.
  *
  * @param color  number of its colour, from 0
  * @param isThin dashed: one that belongs beside another one of the same colour
  */
final case class Series(name: String, color: Int, isThin: Boolean, marks: Vector[Mark])

/** Curves over two logarithmic axes, as a vector graphic: in a page, or (with `standalone`) in a
  * file of its own that follows the reader's light or dark screen.
  *
  * Not a library's chart: those either draw on a canvas, of which a README has nothing, or make
  * pictures with colours that suit one of both screens (docs/decisions/0009).
  *
  * @param guideSlope how the figure should fall, drawn as a dotted line
  */
final class LogLogChart(
    title: String,
    xLabel: String,
    yLabel: String,
    series: Vector[Series],
    guideSlope: Option[Double]
):
  import LogLogChart.*
  import Svg.*

  private val drawn = series.map(s => s.copy(marks = s.marks.filter(m => m.x > 0 && m.y > 0)))
  private val marks = drawn.flatMap(_.marks)
  private val legendRows = (series.size + 2) / 3
  private val bottom = Height - 52 - 20 * legendRows
  private val x = LogAxis.around(marks.map(_.x), Left, Width - Right)
  private val y =
    LogAxis.around(marks.flatMap(m => Vector(m.y, m.low, m.high)), bottom.toDouble, Top)

  def svg: Node = picture(Width, Height, title)(content*)

  def standalone: String =
    val style = element("style")(scalatags.Text.all.raw(Page.chartStyle))
    val back = element("rect", "width" -> "100%", "height" -> "100%", "class" -> "back")()
    picture(Width, Height, title)((Vector(style, back) ++ content)*).render

  private def content: Vector[Frag] =
    grid ++ guide ++ drawn.map(curve) ++ legend :+ text(Left, 22, "charttitle", "start")(title)

  private def grid: Vector[Frag] =
    val vertical = x.ticks.flatMap: value =>
      Vector(
        line(x.at(value), Top, x.at(value), bottom, "grid"),
        text(x.at(value), bottom + 16, "tick", "middle")(Numbers.tick(value))
      )
    val horizontal = y.ticks.flatMap: value =>
      Vector(
        line(Left, y.at(value), Width - Right, y.at(value), "grid"),
        text(Left - 8, y.at(value) + 4, "tick", "end")(Numbers.tick(value))
      )
    val labels = Vector(
      text((Left + Width - Right) / 2, bottom + 34, "axis", "middle")(xLabel),
      element(
        "text",
        "transform" -> s"translate(16 ${px((Top + bottom) / 2)}) rotate(-90)",
        "class" -> "axis",
        "text-anchor" -> "middle"
      )(stringFrag(yLabel))
    )
    vertical ++ horizontal ++ labels

  /** From the first point on, as far as the picture goes. */
  private def guide: Vector[Frag] =
    val first = drawn.flatMap(_.marks.headOption).minByOption(_.x)
    first.toVector.zip(guideSlope).flatMap: (from, slope) =>
      def at(x: Double) = from.y * Math.pow(x / from.x, slope)
      val lowest = marks.map(m => Math.min(m.y, m.low)).min
      val lastX = Math.min(marks.map(_.x).max, from.x * Math.pow(lowest / from.y, 1 / slope))
      Option.when(lastX > from.x * 1.01):
        element("g", "class" -> "guide")(
          line(x.at(from.x), y.at(from.y), x.at(lastX), y.at(at(lastX)), "guideline"),
          tip(s"slope ${Numbers.fixed(slope, 1)}: how independent samples converge")
        )

  private def curve(s: Series): Frag =
    val css = s"series c${s.color % Colors}${if s.isThin then " thin" else ""}"
    val path = s.marks.map(m => s"${px(x.at(m.x))},${px(y.at(m.y))}").mkString(" ")
    val bars =
      for m <- s.marks if m.low > 0 && m.high > m.low * 1.001
      yield line(x.at(m.x), y.at(m.low), x.at(m.x), y.at(m.high), "bar")
    val dots = s.marks.map: m =>
      element("circle", "cx" -> px(x.at(m.x)), "cy" -> px(y.at(m.y)), "r" -> "4")(tip(m.tip))
    element("g", "class" -> css, "data-series" -> s.name)(
      frag((element("polyline", "points" -> path)() +: (bars ++ dots))*)
    )

  private def legend: Vector[Frag] =
    val width = (Width - Left - Right) / 3
    series.zipWithIndex.map: (s, i) =>
      val left = Left + (i % 3) * width
      val height = bottom + 54 + 20 * (i / 3)
      val css = s"series c${s.color % Colors}${if s.isThin then " thin" else ""}"
      element("g", "class" -> css)(
        line(left, height - 4, left + 22, height - 4, "sample"),
        element("circle", "cx" -> px(left + 11), "cy" -> px(height - 4), "r" -> "4")(),
        text(left + 28, height, "legend", "start")(s.name)
      )

object LogLogChart:
  private val Width = 760.0
  private val Height = 460
  private val Left = 70.0
  private val Right = 20.0
  private val Top = 36.0

  /** Of squared errors −1, half the error for double the work; of FLIP nobody knows. */
  def guideOf(metric: Metric): Option[Double] = metric match
    case Metric.Mse | Metric.RelativeMse => Some(-1.0)
    case Metric.Rmse | Metric.Mae => Some(-0.5)
    case Metric.Psnr | Metric.Flip => None

  /** As many as the style has. */
  val Colors = 8

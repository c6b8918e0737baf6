package candela.report

import scalatags.Text.all.Frag

/** Size of a chart and the labels around its curves.
  *
  * @param isWhole whether it has a legend and axis labels
  * @param note subtitle
  */
final case class ChartFrame(
    width: Double,
    height: Double,
    isWhole: Boolean,
    note: Option[String] = None
)

object ChartFrame:
  /** Frame of a standalone chart. */
  val Whole: ChartFrame = ChartFrame(760, 460, isWhole = true)

  /** For narrow windows: its words can be read on a phone. */
  val Narrow: ChartFrame = ChartFrame(380, 360, isWhole = true)

/** Legend of the curves and other lines, in rows of up to `maxColumns` entries.
  *
  * @param lines names and CSS classes of the others
  */
private[report] final class ChartLegend(
    series: Vector[Series],
    lines: Vector[(String, String)],
    maxColumns: Int,
    width: Double
):
  import Svg.*

  private val columns =
    val longest = (series.map(_.name) ++ lines.map(_._1)).map(_.length).maxOption.getOrElse(0)
    Math.max(1, Math.min(maxColumns, (width / (44 + ChartLegend.Letter * longest)).toInt))

  val height: Double = 20.0 * ((series.size + lines.size + columns - 1) / columns)

  def entries(left: Double, top: Double): Vector[Frag] =
    def entry(i: Int, css: String, lineCss: String, name: String, hasDot: Boolean): Frag =
      val x = left + (i % columns) * width / columns
      val y = top + 20 * (i / columns)
      val dot = element("circle", "cx" -> px(x + 11), "cy" -> px(y - 4), "r" -> "4")()
      element("g", "class" -> css)(
        line(x, y - 4, x + 22, y - 4, lineCss),
        scalatags.Text.all.frag(Option.when(hasDot)(dot).toSeq*),
        text(x + 28, y, "legend", "start")(name)
      )
    series.zipWithIndex.map((s, i) =>
      entry(i, LogLogChart.cssOf(s), "sample", s.name, hasDot = true)
    ) ++ lines.zipWithIndex.map:
      case ((name, css), i) => entry(series.size + i, "other", css, name, hasDot = false)

private[report] object ChartLegend:
  /** Typical width of a letter. */
  val Letter = 6.2

/** Grid of small charts with a common legend.
  *
  * @param words   subtitle of the grid
  * @param columns one for narrow windows
  */
private[candela] final class ChartGrid(
    title: String,
    words: String,
    series: Vector[Series],
    panels: Vector[LogLogChart],
    columns: Int = ChartGrid.Columns
):
  import ChartGrid.*
  import Svg.*

  private val width = columns * PanelWidth
  private val inner = width - 2 * Margin
  private val legend = ChartLegend(series, Vector.empty, 4, inner)
  private val heading = lines(title, inner / TitleLetter)
  private val subtitle = lines(words, inner / ChartLegend.Letter)
  private val legendTop = 10.0 + 19 * (heading.size + subtitle.size) + 22
  private val top = legendTop + legend.height
  private val height = top + PanelHeight * ((panels.size + columns - 1) / columns)

  def svg: Node = picture(width, height, title)(content*)

  def standalone: String = Svg.standalone(width, height, title)(content)

  private def content: Vector[Frag] =
    val captions = heading.map("charttitle" -> _) ++ subtitle.map("axis" -> _)
    val head = captions.zipWithIndex.map:
      case ((css, words), i) => text(Margin, 24.0 + 19 * i, css, "start")(words)
    val charts = panels.zipWithIndex.map: (panel, i) =>
      moved((i % columns) * PanelWidth, top + (i / columns) * PanelHeight)(panel.content)
    head ++ legend.entries(Margin, legendTop) ++ charts

private[candela] object ChartGrid:
  val Columns = 3

  /** Typical width of a letter of titles. */
  private val TitleLetter = 8.0

  private val PanelWidth = 310.0
  private val PanelHeight = 250.0
  private val Margin = 14.0

  /** Words in lines of at most `maxLetters` letters. */
  private def lines(words: String, maxLetters: Double): Vector[String] =
    words.split(' ').foldLeft(Vector.empty[String]): (completed, word) =>
      completed.lastOption match
        case Some(last) if last.length + word.length < maxLetters =>
          completed.init :+ s"$last $word"
        case _ => completed :+ word

  /** Frame of a chart in the grid. */
  def frame(note: String): ChartFrame =
    ChartFrame(PanelWidth, PanelHeight, isWhole = false, Some(note))

/** Logarithmic axis from `low` to `high`, drawn from `start` to `end` pixels. */
private[report] final class LogAxis(low: Double, high: Double, start: Double, end: Double):

  def pixel(value: Double): Double =
    val fraction = (Math.log(value) - Math.log(low)) / (Math.log(high) - Math.log(low))
    start + fraction * (end - start)

  /** Powers of ten; on a short axis also some of their multiples. */
  def ticks: Vector[Double] =
    val decades = Math.log10(high / low)
    val steps =
      if decades < 0.8 then Vector(1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
      else if decades < 2.2 then Vector(1.0, 2.0, 5.0)
      else Vector(1.0)
    for
      exponent <- (Math.floor(Math.log10(low)).toInt to Math.ceil(Math.log10(high)).toInt).toVector
      step <- steps
      value = step * Math.pow(10, exponent)
      if value >= low * 0.9999 && value <= high * 1.0001
    yield value

private[report] object LogAxis:

  /** An axis with a margin around the extreme values, spanning at least half a decade. */
  def covering(values: Vector[Double], start: Double, end: Double): LogAxis =
    val logs = values.filter(_ > 0).map(Math.log10)
    val (minLog, maxLog) = if logs.isEmpty then (0.0, 1.0) else (logs.min, logs.max)
    val middle = (minLog + maxLog) / 2
    val halfSpan = Math.max(0.25, (maxLog - minLog) / 2 * 1.08)
    LogAxis(Math.pow(10, middle - halfSpan), Math.pow(10, middle + halfSpan), start, end)

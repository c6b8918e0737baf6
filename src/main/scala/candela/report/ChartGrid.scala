package candela.report

import scalatags.Text.all.Frag

/** Small charts side by side, with one legend for all.
  *
  * @param words below the title: what all of the charts show
  */
private[report] final class ChartGrid(
    title: String,
    words: String,
    series: Vector[Series],
    panels: Vector[LogLogChart]
):
  import ChartGrid.*
  import Svg.*

  private val columns = Math.min(Columns, Math.max(1, panels.size))
  private val width = Columns * PanelWidth
  private val legend = ChartLegend(series, LegendColumns, width - 2 * Margin)
  private val top = 66 + legend.height
  private val height = top + PanelHeight * ((panels.size + columns - 1) / columns)

  def svg: Node = picture(width, height, title)(content*)

  def standalone: String = Svg.standalone(width, height, title)(content)

  private def content: Vector[Frag] =
    val head = Vector(
      text(Margin, 24, "charttitle", "start")(title),
      text(Margin, 43, "axis", "start")(words)
    )
    val all = panels.zipWithIndex.map: (panel, i) =>
      moved((i % columns) * PanelWidth, top + (i / columns) * PanelHeight)(panel.content)
    head ++ legend.at(Margin, 68) ++ all

private[report] object ChartGrid:
  private val Columns = 3
  private val LegendColumns = 4
  private val PanelWidth = 310.0
  private val PanelHeight = 250.0
  private val Margin = 14.0

  /** Of a chart in the grid. */
  def frame(note: String): ChartFrame =
    ChartFrame(PanelWidth, PanelHeight, isWhole = false, Some(note))

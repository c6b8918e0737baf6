package candela.report

import scalatags.Text.all.Frag

/** How large a chart is, and what stands around its curves.
  *
  * @param isWhole whether it has a legend, and words at its axes
  * @param note    what there is to say below its title
  */
final case class ChartFrame(
    width: Double,
    height: Double,
    isWhole: Boolean,
    note: Option[String] = None
)

object ChartFrame:
  /** Of a chart that stands alone. */
  val Whole: ChartFrame = ChartFrame(760, 460, isWhole = true)

/** Which curve is whose, in rows of some columns. */
private[report] final class ChartLegend(series: Vector[Series], columns: Int, width: Double):
  import Svg.*

  val height: Double = 20.0 * ((series.size + columns - 1) / columns)

  def at(left: Double, top: Double): Vector[Frag] =
    series.zipWithIndex.map: (s, i) =>
      val x = left + (i % columns) * width / columns
      val y = top + 20 * (i / columns)
      element("g", "class" -> LogLogChart.cssOf(s))(
        line(x, y - 4, x + 22, y - 4, "sample"),
        element("circle", "cx" -> px(x + 11), "cy" -> px(y - 4), "r" -> "4")(),
        text(x + 28, y, "legend", "start")(s.name)
      )

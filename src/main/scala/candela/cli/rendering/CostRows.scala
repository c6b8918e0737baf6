package candela.cli.rendering

import candela.base.{ByteCount, JavaHeap}
import candela.cli.terminal.Figures
import candela.render.{Cost, CostKind, Costs, Rendering}
import candela.report.CostFigure

/** What a rendering takes memory and time for, in words. */
private[cli] object CostRows:

  /** The memory of all, then of each part, with the time that it has taken: (what, value). */
  def of(costs: Costs): Vector[(String, String)] =
    val all = s"about ${ByteCount.show(costs.bytes)} of ${ByteCount.show(JavaHeap.limit)}"
    ("memory" -> all) +: costs.told.map(c => s"  ${c.kind.word}" -> text(c))

  /** The parts, with the time of the rendering, too.
    *
    * @param film seconds that its development and its files took
    */
  def figures(costs: Costs, rendering: Rendering, film: Double): Vector[CostFigure] =
    val more = Vector(CostKind.Guiding -> rendering.learning, CostKind.Film -> film)
    val all = costs ++ more.filter(_._2 > 0).map((kind, seconds) => Cost(kind, 0, seconds))
    all.told.map(c => CostFigure(c.kind.word, c.bytes, c.seconds, text(c)))

  private def text(cost: Cost): String =
    val most = if cost.isMost then "at most " else ""
    val bytes = Option.when(cost.bytes > 0)(most + ByteCount.show(cost.bytes))
    val seconds = Option.when(cost.seconds >= Costs.MinSeconds)(Figures.duration(cost.seconds))
    (bytes ++ seconds).mkString(", ")

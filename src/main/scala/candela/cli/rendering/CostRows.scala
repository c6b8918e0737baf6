package candela.cli.rendering

import candela.base.{ByteCount, Figures, JavaHeap}
import candela.render.{Cost, CostKind, Costs, Rendering}
import candela.report.CostFigure

/** What a rendering takes memory and time for, in words. */
private[cli] object CostRows:

  /** The memory of all, then of each part, with the time that it has taken: (what, value). */
  def of(costs: Costs): Vector[(String, String)] =
    val memory = s"about ${ByteCount.format(costs.bytes)} of ${ByteCount.format(JavaHeap.limit)}"
    ("memory" -> memory) +: costs.reported.map(c => s"  ${c.kind.word}" -> text(c))

  /** The parts, with the time of the rendering, too.
    *
    * @param film seconds that its development and its files took
    */
  def figures(costs: Costs, rendering: Rendering, film: Double): Vector[CostFigure] =
    val extra = Vector(CostKind.Guiding -> rendering.learning, CostKind.Film -> film)
    val allCosts = costs ++ extra.filter(_._2 > 0).map((kind, seconds) => Cost(kind, 0, seconds))
    allCosts.reported.map(c => CostFigure(c.kind.word, c.bytes, c.seconds, text(c)))

  private def text(cost: Cost): String =
    val prefix = if cost.isMost then "at most " else ""
    val bytes = Option.when(cost.bytes > 0)(prefix + ByteCount.format(cost.bytes))
    val seconds = Option.when(cost.seconds >= Costs.MinSeconds)(Figures.duration(cost.seconds))
    (bytes ++ seconds).mkString(", ")

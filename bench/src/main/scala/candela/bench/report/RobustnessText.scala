package candela.bench.report

import candela.bench.statistics.Statistics
import candela.report.Numbers

/** Figures of the table of robustness, as texts. */
object RobustnessText:

  /** With the number of trials to which its bounds are converted: `Leaks, per 10⁹`. */
  def title(g: RobustGroup): String =
    g.title + (if g.per > 0 then s", per ${Numbers.tick(g.per)}" else "")

  /** As in `0 of 10⁶ (≤ 3000)`, `25 of 100 (25 %)` or `0.4998`.
    *
    * @param per number of trials to which the bound is converted; 0 for a share
    */
  def cell(r: Robust, per: Double): String = r match
    case Robust.Counted(faults, trials, _) =>
      val bound = Statistics.countLimit(faults) / trials * per
      val counted = s"$faults of ${Numbers.count(trials)}"
      if per == 0 || faults > trials / 100 then
        s"$counted (${Numbers.percentage(faults.toDouble / trials)})"
      else s"$counted (≤ ${Numbers.tick(bound)})"
    case Robust.Mean(found, _, _, _) => Numbers.short(found)
    case Robust.Absent(why) => why
    case Robust.Failed(why) => why

  /** Value that is right, if it is one for all programs. */
  def expected(row: RobustRow): Option[String] =
    val expectedValues = row.cells.values.collect { case Robust.Mean(_, _, e, _) =>
      e
    }.toVector.distinct
    Option.when(expectedValues.sizeIs == 1)(Numbers.short(expectedValues.head))

  /** Markdown: a table for each group. */
  def markdown(r: RobustnessReport): String =
    val head = Vector(
      s"Candela ${r.version}, ${r.machine.java}, ${r.machine.processor}, ${r.begun}, " +
        s"${Numbers.count(r.rays)} trials a row. Made by",
      "",
      s"    ${r.command}",
      "",
      "Bold: a fault. In parentheses: the upper end of the 95 % interval, converted to the " +
        "number of trials in the table's head. Blank: not measured."
    )
    val groups = r.groups.flatMap(group(r, _))
    val omissions = r.leftOut.map((what, why) => s"- $what: $why")
    val notRun = if omissions.isEmpty then omissions else Vector("", "Not run:", "") ++ omissions
    (head ++ groups ++ notRun).mkString("", "\n", "\n")

  private def group(r: RobustnessReport, g: RobustGroup): Vector[String] =
    val programs = r.programsOf(g)
    val hasValues = g.rows.exists(expected(_).isDefined)
    val titles = Vector(title(g)) ++ Option.when(hasValues)("expected") ++ programs.map(_.title)
    val rows = g.rows.map: row =>
      val cells = programs.map: p =>
        row.cells.get(p.key).fold(""): c =>
          if c.isFaulty then s"**${cell(c, g.per)}**" else cell(c, g.per)
      Vector(row.what) ++ Option.when(hasValues)(expected(row).getOrElse("")) ++ cells
    val notes = g.reasons.flatMap((why, rows) => Vector("", s"${rows.mkString(", ")}: $why"))
    Vector("", s"### ${g.title}", "", g.words, "", line(titles), "|---" * titles.size + "|") ++
      rows.map(line) ++ notes

  private def line(cells: Vector[String]): String =
    cells.map(_.replace("|", "\\|")).mkString("| ", " | ", " |")

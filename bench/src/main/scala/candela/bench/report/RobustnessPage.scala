package candela.bench.report

import candela.report.{Numbers, Page, Viewer}
import scalatags.Text.all.*

/** Page of `candela robustness`: a table of each kind of fault, and pictures where programs differ.
  */
object RobustnessPage:

  def html(r: RobustnessReport): String =
    val conditions = s"${r.begun} on ${r.machine.processor}, ${r.machine.java}"
    val broken = r.broken.map((g, row) => s"${g.title}: ${row.what}")
    Page.html("Numerical robustness", conditions, r.version)(
      Option.when(broken.nonEmpty)(div(
        cls := "warning",
        attr("role") := "note",
        broken.map(words => p(s"⚠ Candela is not as promised: $words."))
      )),
      p(
        "Bold: a fault. In parentheses: the upper end of the 95 % interval, converted to the " +
          "number of trials in the table's head. Blank: not measured."
      ),
      r.groups.map(group(r, _)),
      h2("Method"),
      p(
        s"Each row has ${Numbers.count(r.rays)} trials or a part of them, with the same random " +
          "numbers in every run."
      ),
      Option.when(r.leftOut.nonEmpty)(frag(h3("Not run"), Page.facts(r.leftOut))),
      h3("Machine"),
      Page.facts(r.machine.rows ++ Vector(
        "version" -> s"Candela ${r.version}",
        "command" -> r.command,
        "seconds" -> Numbers.fixed(r.seconds, 0)
      ))
    )

  private def group(r: RobustnessReport, g: RobustGroup): Frag =
    val programs = r.programsOf(g)
    val hasValues = g.rows.exists(RobustnessText.expected(_).isDefined)
    val rowLabel = if g.per > 0 then s"per ${Numbers.tick(g.per)}" else "scene"
    val head = Vector(rowLabel) ++ Option.when(hasValues)("expected") ++ programs.map(_.title)
    val rows = g.rows.map: row =>
      val expected = Option.when(hasValues)(td(RobustnessText.expected(row).getOrElse("")))
      val cells = programs.map: p =>
        row.cells.get(p.key).fold(td()): c =>
          td(Option.when(c.isFaulty)(cls := "best"), RobustnessText.cell(c, g.per))
      tr(td(row.what), expected, cells)
    frag(
      h2(g.title),
      p(g.words),
      Page.scrolling(head, rows),
      g.reasons.map((why, all) => p(cls := "soft", s"${all.mkString(", ")}: $why")),
      g.rows.filter(_.pictures.nonEmpty).map(row => frag(h3(row.what), Viewer(row.pictures)))
    )

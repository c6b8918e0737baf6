package candela.convert

/** The tables of all passes as a page of documentation. */
object Documentation:

  def markdown: String =
    Vector(
      ("From v3 to v4", ToV4View.pass),
      ("From v4 to v3", ToV3View.pass),
      ("From v2 to v3 (and on to v4)", FromV2.pass)
    ).map((title, pass) => s"## $title\n\n${chapter(pass)}").mkString("\n")

  private def chapter(pass: Pass): String =
    pass.tables.filter(_.rules.nonEmpty).map(table).mkString("\n")

  private def table(t: Table): String =
    val all = t.rules.flatMap(_.steps.map(written))
    val common = all.distinct.filter(step => all.count(_ == step) >= Several)
    val others = t.fallback.fold("dropped, with a warning")(f => s"`$f`, with a warning")
    val types = s"Other types: $others."
    val shared =
      if common.isEmpty then ""
      else s" Parameters of several types: ${common.mkString("; ")}."
    val head = "| type | converted to | parameters |\n|---|---|---|\n"
    s"### ${t.category}\n\n$types$shared\n\n$head" + t.rules.map(row(_, common.toSet)).mkString

  /** From so many types on, a step is listed once for its category. */
  private val Several = 3

  private def written(step: Step): String =
    val target = if step.target.startsWith("ignored") then "ignored" else step.target
    s"${step.source} → $target"

  private def row(r: Rule, common: Set[String]): String =
    val names = r.sourceNames.map(n => s"`\"$n\"`").mkString(", ")
    val note = r.note.fold("")(n => s"*Approximate, with a warning: $n.*<br>")
    val steps = r.steps.map(written).filterNot(common).mkString("<br>")
    s"| $names | `\"${r.to}\"` | $note$steps |\n".replace("  |", " |")

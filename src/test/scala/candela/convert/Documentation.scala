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
    val head = s"### ${t.category}\n\n| type | converted to | parameters |\n|---|---|---|\n"
    val other = t.fallback.fold("dropped, with a warning")(f => s"`$f`, with a warning")
    head + t.rules.map(row).mkString + s"| any other | $other | |\n"

  private def row(r: Rule): String =
    val names = r.from.map(n => s"`\"$n\"`").mkString(", ")
    val note = r.note.fold("")(n => s"*Approximate, with a warning: $n.*<br>")
    val steps = r.steps.map(s => s"${s.source} → ${s.target}").mkString("<br>")
    s"| $names | `\"${r.to}\"` | $note$steps |\n"

package candela.cli

import candela.base.{Excerpt, Problem, Severity, SourcePos}

/** The one place that says how a problem looks as text:
  *
  * {{{
  * scenes/camera.pbrt:14:15: error: LookAt takes 9 numbers, but number 4 is `Camera`
  *  14 | LookAt 0 0 5  Camera
  *     |               ^
  *  usage: LookAt eye.x eye.y eye.z  look.x look.y look.z  up.x up.y up.z
  *  included from scenes/main.pbrt:3:1
  * }}}
  */
object ProblemText:

  /** The problem in some lines, without a line end after the last. */
  def format(p: Problem): String =
    val severity = if p.severity == Severity.Error then "error" else "warning"
    val head = p.at.fold("")(at => s"$at: ") + s"$severity: ${p.message}"
    val shown = p.at.zip(p.excerpt).toVector.flatMap(excerpt)
    val help = p.help.map(h => s" $h")
    (Vector(head) ++ shown ++ help ++ p.at.toVector.flatMap(includes)).mkString("\n")

  private def excerpt(at: SourcePos, text: String): Vector[String] =
    val number = at.line.toString
    val before = Excerpt.caret(text, at.column) - 1
    // tabs stay tabs, so that the caret keeps its place however wide they are shown
    val characters = text.codePoints.limit(before).toArray
    val shift = characters.map(c => if c == '\t' then '\t' else ' ').mkString
    Vector(s" $number | $text", s" ${" " * number.length} | ${shift.padTo(before, ' ')}^")

  private def includes(at: SourcePos): Vector[String] =
    Vector.unfold(at.includedFrom)(_.map(from => (s" included from $from", from.includedFrom)))

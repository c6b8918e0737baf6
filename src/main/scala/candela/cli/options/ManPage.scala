package candela.cli.options

import candela.base.Version

import java.util.Locale
import scopt.OptionDef

/** The manual page candela(1), as the option tables have it.
  *
  * Source: man-pages(7) and groff_man(7): names of sections and macros.
  */
private[cli] object ManPage:

  /** Of the last change to the page's form; what it says is of the version. */
  private val Date = "2026-11-26"

  def lines: Vector[String] =
    s""".TH CANDELA 1 "$Date" "Candela ${Version.current}" "User Commands"""" +:
      (head ++ commands ++ Manual.sections.flatMap(section) ++ seeAlso)

  private def head: Vector[String] =
    Vector(".SH NAME", s"candela \\- ${escaped(Manual.Purpose)}", ".SH SYNOPSIS") ++
      CommandTable.rows.flatMap(r => Vector(".br", bold(r.usage))).tail

  private def commands: Vector[String] =
    ".SH COMMANDS" +: CommandTable.rows.flatMap: row =>
      val options = row.options.flatMap(o => ".TP" +: name(o) +: text(OptionText.sentences(o.desc)))
      s".SS ${escaped(row.usage)}" +: (text(row.page) ++ options)

  private def name(o: OptionDef[?, Options]): String =
    val short = o.shortOpt.fold("")(s => s"${bold(s"-$s")}, ")
    val value = o.valueName.fold("")(v => s" \\fI${escaped(v)}\\fR")
    s"$short${bold(s"--${o.name}")}$value"

  private def section(s: Manual.Section): Vector[String] =
    s".SH ${s.title.toUpperCase(Locale.ROOT)}" +: s.parts.zipWithIndex.flatMap: (part, i) =>
      part match
        case Manual.Part.Paragraph(p) => Option.when(i > 0)(".PP").toVector ++ text(p)
        case Manual.Part.Table(_, rows) =>
          rows.flatMap(r => ".TP" +: text(r.head) :++ text(r.tail.mkString(" ")))

  private def seeAlso: Vector[String] =
    ".SH SEE ALSO" +: text("`candela describe` prints the reference of scenes.")

  /** Markdown as roff, a sentence a line: code is bold, links are their words. */
  private def text(markdown: String): Vector[String] =
    val plain = OptionText.unlinked(markdown)
    // Between backticks is every second part
    val segments = plain.split("`", -1).toVector.zipWithIndex
    val roff = segments.map((t, i) => if i % 2 == 1 then bold(t) else escaped(t)).mkString
    roff.split("(?<=[a-z)R]\\.) (?=[A-Z])").toVector

  private def bold(s: String): String = s"\\fB${escaped(s)}\\fR"

  /** Without meaning to roff; all characters are ASCII, so that no formatter needs an encoding. */
  private def escaped(s: String): String =
    val roff = s.replace("\\", "\\e").replace("-", "\\-")
    val ascii = StringBuilder()
    roff.codePoints.forEach: c =>
      if c < 128 then ascii += c.toChar: Unit
      else ascii ++= "\\[u%04X]".formatLocal(Locale.ROOT, c): Unit
    if ascii.startsWith(".") || ascii.startsWith("'") then s"\\&$ascii" else ascii.toString

package candela.cli.options

import java.util.Locale

import scopt.OptionDef

/** docs/COMMANDS.md: all commands and options, as the option tables have them. */
private[cli] object CommandsPage:

  def lines: Vector[String] =
    Introduction.linesIterator.toVector ++ overview ++ CommandTable.rows.flatMap(command) ++
      ("" +: s"## $SharedTitle" +: "" +: table(Vector("option", "effect"), shared)) ++
      Manual.sections.flatMap(section)

  private def overview: Vector[String] =
    val links =
      Manual.sections.map(s => s"[${s.title.toLowerCase(Locale.ROOT)}](#${anchor(s.title)})")
    "" +: table(
      Vector("command", "effect"),
      CommandTable.rows.map: r =>
        val module = r.command.module.fold("")(name => s" (module `$name`)")
        Vector(s"[`${r.command.word}`](#candela-${r.command.word})", r.meaning + module)
    ) :++ Vector(
      "",
      "`candela help` lists the commands, `candela help COMMAND` or `candela COMMAND --help` the " +
        "options of one; `candela version` prints the version.",
      "",
      s"For all commands: ${links.init.mkString(", ")} and ${links.last}."
    )

  private def command(row: CommandRow): Vector[String] =
    val arguments = row.arguments.flatMap(_.toList).map(a => Vector(s"`${a.name}`", a.desc))
    val (common, special) = row.options.partition(o => shared.contains(described(o)))
    val rows = arguments ++ special.map(described)
    val names = common.map(o => s"`--${o.name}`").mkString(", ")
    val footer =
      if common.isEmpty then Vector.empty
      else Vector("", s"[Also](#${anchor(SharedTitle)}): $names.")
    Vector("", s"## candela ${row.command.word}", "", s"`${row.usage}`", "", row.page, "") ++
      table(Vector(if row.options.isEmpty then "argument" else "option", "effect"), rows) ++ footer

  /** Name and text. */
  private def described(o: OptionDef[?, Options]): Vector[String] =
    Vector(name(o), OptionText.sentences(o.desc))

  /** Options that at least three commands have in the same form. */
  private lazy val shared: Vector[Vector[String]] =
    val options = CommandTable.rows.flatMap(_.options.map(described))
    options.distinct.filter(o => options.count(_ == o) >= 3)

  private def name(o: OptionDef[?, Options]): String =
    val value = o.valueName.fold("")(v => s" $v")
    s"`--${o.name}$value`${o.shortOpt.fold("")(s => s", `-$s`")}"

  private def section(s: Manual.Section): Vector[String] =
    "" +: s"## ${s.title}" +: s.parts.flatMap: part =>
      "" +: (part match
        case Manual.Part.Paragraph(text) => Vector(text)
        case Manual.Part.Table(head, rows) => table(head, rows))

  private def anchor(title: String): String = title.toLowerCase(Locale.ROOT).replace(' ', '-')

  private def table(head: Vector[String], rows: Vector[Vector[String]]): Vector[String] =
    row(head) +: ("|" + "---|" * head.size) +: rows.map(row)

  private def row(cells: Vector[String]): String =
    cells.map(_.replace("|", "\\|")).mkString("| ", " | ", " |")

  private val SharedTitle = "Options of several commands"

  private val Introduction: String =
    """# Commands
      |
      |All commands and options of `candela`. This page is generated from the tables that `--help`
      |prints: `./sbt "run describe --commands --outfile docs/COMMANDS.md"`. The same as a manual
      |page: `candela describe --man`. The words of pbrt's command lines are understood, too:
      |[pbrt's options](PBRT-OPTIONS.md).""".stripMargin

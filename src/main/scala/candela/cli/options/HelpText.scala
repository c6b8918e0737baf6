package candela.cli.options

import candela.diagnostics.{Code, Suggest}
import candela.cli.terminal.{ExitCode, TextTable}

import scopt.OptionDef

/** What `--help` prints.
  *
  * @param columns width of the text
  */
private[cli] final class HelpText(columns: Int):
  import HelpText.*

  /** Of the whole program: its commands, and the options that most people need. */
  def overview: Vector[String] =
    val commands = CommandTable.rows.map(r => row(r.command.word, r.meaning, CommandWidth))
    val render = CommandTable.of(Command.Render)
    val options = Usual.flatMap(render.option).map(option)
    Vector(
      VersionText.program(),
      "usage: candela [command] [options] file...",
      ""
    ) ++ commands.flatten ++ ("" +: TextTable.wrap(More, columns)) ++ options.flatten ++ (
      "" +: Notes.flatMap(TextTable.wrap(_, columns))
    )

  /** Of one command: all its arguments and options. */
  def of(command: Command): Vector[String] =
    val r = CommandTable.of(command)
    val notes = if command == Command.Render then Notes else Vector.empty
    Vector(s"usage: ${r.usage}", "") ++ TextTable.wrap(s"${r.meaning.capitalize}.", columns) ++
      ("" +: r.arguments.flatMap(_.toList).flatMap(a => row(a.name, a.desc))) ++
      r.options.flatMap(option) ++ row("-h, --help", "print this help") ++
      (if notes.isEmpty then notes else "" +: notes.flatMap(TextTable.wrap(_, columns)))

  private def option(o: OptionDef[?, Options]): Vector[String] =
    val short = o.shortOpt.fold("")(s => s"-$s, ")
    val value = o.valueName.fold("")(v => s" $v")
    row(s"$short--${o.name}$value", OptionText.short(o.desc))

  /** A name, and behind it, or below if it is long, the text. */
  private def row(name: String, text: String, width: Int = NameWidth): Vector[String] =
    val lines = TextTable.wrap(text, Math.max(MinTextColumns, columns - width - Indent.length))
    val margin = Indent + " " * width
    if name.length + 2 <= width then
      s"$Indent${name.padTo(width, ' ')}${lines.head}" +: lines.tail.map(margin + _)
    else broken(name) ++ lines.map(margin + _)

  /** A long name as lines, which end after `|` or `,`. */
  private def broken(name: String): Vector[String] =
    val segments = name.split("(?<=[|,])").toVector
    val lines = segments.tail.foldLeft(Vector(Indent + segments.head)): (done, part) =>
      if done.last.length + part.length <= columns then done.init :+ done.last + part
      else done :+ Indent * 4 + part
    lines

private[cli] object HelpText:
  private val Indent = "  "
  private val NameWidth = 26
  private val CommandWidth = 12
  private val MinTextColumns = 24

  /** Options in the overview. */
  private val Usual =
    Vector("outfile", "resolution", "spp", "time", "error", "cropwindow", "denoise", "watch")

  private val More = "`candela help COMMAND` lists the options of a command. Some of render's:"

  private val Notes = Vector(
    "Without --outfile the scene's Film names the image, or else the scene file does, and a " +
      "preview is written next to it: what --outfile x.exr,x.png does.",
    "Ctrl-C stops rendering and writes the partial image; a second Ctrl-C quits at once.",
    "Film files (.film) save renderings: --checkpoint, resume, --shard, merge.",
    ExitCode.values.map(c => s"${c.number} ${c.word}").mkString("Exit codes: ", ", ", ".")
  )

/** What is wrong with a command line. */
private[cli] final case class UsageError(code: Code, message: String)

/** Errors of command lines, in one form: what is wrong with which option or file, what was found,
  * and the nearest name.
  */
private[cli] object UsageErrors:

  /** What scopt shall say of a value.
    *
    * @param item the part of it that is wrong
    */
  def unread(expected: String, item: String): IllegalArgumentException =
    IllegalArgumentException(s"expected $expected\n$item")

  /** The texts of errors.
    *
    * @param errors as scopt words them
    */
  def explained(errors: Vector[String], command: Command): Vector[UsageError] =
    val row = CommandTable.of(command)
    val specific = errors.filterNot(_.startsWith("Missing argument"))
    // What follows a faulty option may be taken for its value
    (if specific.isEmpty then errors else specific).map(usageError(_, row)).distinct

  private def usageError(error: String, row: CommandRow): UsageError =
    val command = s"`candela ${row.command.word}`"
    def invalid(name: String, what: String, found: String, whole: String = "") = UsageError(
      Code.OptionValue,
      if found.isEmpty && whole.isEmpty then s"--$name needs a value: ${valueOf(name, row)}"
      else
        val list = if whole.isEmpty || whole == found then "" else s" in `$whole`"
        s"--$name must be $what, found `$found`$list${suggestion(what, found)}"
    )
    def missing(what: String) = UsageError(Code.MissingArgument, s"$command needs $what")
    error match
      case s"Unknown option $option" => UsageError(Code.UnknownOption, unknown(option, row))
      case s"Unknown argument '$file'" =>
        val files = row.files.mkString(" and ")
        val message =
          if row.files.isEmpty then s"$command takes only options; unexpected argument `$file`"
          else s"$command takes $files; unexpected argument `$file`"
        UsageError(Code.MoreArguments, message)
      case s"Missing argument $file" => missing(s"a file: $file")
      case s"Missing option --$name" => missing(s"--$name ${valueOf(name, row)}")
      case s"Missing value after $option" =>
        val word = option.dropWhile(_ == '-')
        val name = row.options.find(_.shortOpt.contains(word)).fold(word)(_.name)
        invalid(name, "", "")
      case s"Option --$name expects a number but was given '$found'" =>
        val isDecimal = row.option(name).exists(_.valueName.contains("X"))
        invalid(name, if isDecimal then "a number" else number(found), found)
      case s"Option --$name failed when given '$whole'. expected $what\n$found" =>
        invalid(name, what, found, whole)
      case s"Option --$name failed when given '$found'. expected $what" =>
        invalid(name, what, found)
      case s"--$_ must be $_" => UsageError(Code.OptionValue, error)
      case other => UsageError(Code.OptionConflict, other)

  private def number(found: String): String =
    scala.util.Try(BigInt(found)).fold(
      _ => "a whole number",
      n => if n > 0 then s"at most ${Int.MaxValue}" else s"at least ${Int.MinValue}"
    )

  private def valueOf(name: String, row: CommandRow): String =
    row.option(name).flatMap(_.valueName).getOrElse("VALUE")

  /** The nearest of the words that are understood, if there are any. */
  private def suggestion(what: String, found: String): String =
    val words = what.split("[^A-Za-z0-9-]+").toVector
      .filter(w => w.length > 2 && !Prose(w) && w.exists(_.isLetter))
    val nearest = if found.length > 2 then Suggest.nearest(found, words) else None
    nearest.filter(_ != found).fold("")(w => s"; did you mean `$w`?")

  private val Prose = Set("one", "more", "with", "and", "above", "names", "such", "likewise")

  private def unknown(option: String, row: CommandRow): String =
    val name = option.dropWhile(_ == '-').takeWhile(c => c != '=' && c != ':')
    val options = row.options
    val isShort = !option.startsWith("--")
    if row.option("define").isDefined && isShort && name.startsWith("D") then
      s"-D needs a value, as in -D${Some(name.tail).filter(_.nonEmpty).getOrElse("NAME")}=VALUE"
    else if options.exists(o => o.name == name || (isShort && o.shortOpt.contains(name))) then
      s"--${options.find(o => o.name == name || o.shortOpt.contains(name)).get.name} is given twice"
    else
      val otherRows = CommandTable.rows.filter(r => r != row && r.option(name).isDefined)
      val nearest = Suggest.nearest(name, "help" +: options.map(_.name))
      val hint =
        if Synonyms.get(name).exists(s => options.exists(_.name == s)) then
          s"; did you mean `--${Synonyms(name)}`?"
        else if Statements.contains(name) then
          s"; the scene has it, in its ${Statements(name)} statement"
        else if otherRows.nonEmpty then
          val words = otherRows.map(r => s"`${r.command.word}`")
          s"; ${listed(words)} ${if words.size == 1 then "has" else "have"} it"
        else nearest.fold("")(k => s"; did you mean `--$k`?")
      s"`candela ${row.command.word}` has no option `${option.stripSuffix("=")}`$hint"

  /** Options by the words that other programs have for them. */
  private val Synonyms = Map(
    "width" -> "resolution",
    "height" -> "resolution",
    "size" -> "resolution",
    "res" -> "resolution",
    "r" -> "resolution",
    "w" -> "resolution",
    "samples" -> "spp",
    "output" -> "outfile",
    "threads" -> "nthreads"
  )

  /** Statements of scenes by what they say, which other programs have options for. */
  private val Statements =
    Map("integrator" -> "Integrator", "maxdepth" -> "Integrator", "fov" -> "Camera")

  private def listed(words: Vector[String]): String =
    if words.size < 2 then words.mkString else s"${words.init.mkString(", ")} and ${words.last}"

package candela.bench

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{FileName, Scratch, WholeFile}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import scala.util.Using

import candela.bench.report.{
  Robust, RobustGroup, RobustnessData, RobustnessPage, RobustnessReport, RobustnessText, RobustRow
}
import candela.bench.robustness.RobustnessRun
import candela.cli.files.{FileRegister, Output, OutputFiles}
import candela.cli.options.{CommandRow, CommandService, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.render.Cancellation

/** `candela robustness`, as the program looks it up. */
final class RobustnessService extends CommandService:
  def row: CommandRow = RobustnessTable.row

  def run(options: Options, terminal: Terminal, report: Report): ExitCode =
    RobustnessCommand(options, terminal, report).run()

/** `candela robustness`: counts numerical faults of Candela, and of other programs that are there.
  */
final class RobustnessCommand(options: Options, terminal: Terminal, report: Report):
  private val settings = RobustnessOptions.of(options)
  private val cancellation = Cancellation()
  private val cores = Runtime.getRuntime.availableProcessors
  private var begun = Option.empty[String]

  def run(): ExitCode = report.guarded:
    val paths = options.reports.map(OutputFiles.path).distinct
    paths.foreach(check)
    val register = FileRegister()
    register.write(Output(paths, "report", "robustness", "report"))
    terminal.interrupts.during(cancellation):
      val results = Using.resource(Scratch.create())(scratch => measured(scratch.folder))
      OutputFiles.writeAll(paths): path =>
        WholeFile.write(path, text(path, results).getBytes(UTF_8))
      if !options.quiet then for path <- paths do terminal.out.println(s"wrote $path")
      val code = judged(results)
      terminal.out.flush()
      if cancellation.isRequested then ExitCode.Interrupted else code

  private def measured(scratch: Path): RobustnessReport =
    val chosen =
      RobustnessRun.all.filter(m => settings.only.isEmpty || settings.only.contains(m.key))
    val run = RobustnessRun(
      settings.rays, chosen, cores, settings.python, scratch, commandLine, cancellation, printRow
    )
    if !options.quiet then
      for (what, why) <- run.leftOut do terminal.err.println(s"skipped: $what: $why")
    run.report()

  /** Without `--report`, whose files are where the reader found the table. */
  private def commandLine: String =
    val selection = Option.when(settings.only.nonEmpty)(s"--only ${settings.only.mkString(",")}")
    (Vector("candela robustness", s"--rays ${settings.rays}") ++ selection).mkString(" ")

  private def printRow(group: RobustGroup, row: RobustRow): Unit =
    if !options.quiet then
      if !begun.contains(group.key) then
        begun = Some(group.key)
        terminal.out.println(s"${RobustnessText.title(group)} (${group.key})")
      val cells = row.cells.toVector.sortBy(_._1).map: (key, cell) =>
        val mark = if cell.isFaulty then "FAULT " else ""
        s"$key $mark${RobustnessText.cell(cell, group.per)}"
      terminal.out.println(s"  ${row.what}: ${cells.mkString("; ")}")
      terminal.out.flush()

  private def judged(results: RobustnessReport): ExitCode =
    val broken = results.broken
    for (group, row) <- broken do
      terminal.err.println(s"not as promised: ${group.title}: ${row.what}")
      for why <- row.cells.values.flatMap(firstFault) do terminal.err.println(s"  $why")
    if !options.quiet then
      val rows = results.groups.map(_.rows.size).sum
      terminal.out.println(
        if broken.isEmpty then s"${Figures.count(rows, "row")}: Candela is as promised in all"
        else s"${Figures.count(rows, "row")}: Candela is not as promised in ${broken.size}"
      )
    if broken.isEmpty then ExitCode.Done else ExitCode.BadInput

  private def firstFault(cell: Robust): Option[String] = cell match
    case Robust.Counted(_, _, first) => first
    case Robust.Failed(why) => Some(why)
    case _ => None

  private def check(path: Path): Unit =
    if !Vector("html", "json", "md").contains(FileName.suffix(path)) then
      val help = Some("reports are written as .html, .json or .md")
      throw SceneError(Problem.general(Code.UnknownFormat, s"can't write `$path`", help))
    for problem <- FileRegister.obstacle(path) do throw SceneError(problem)

  private def text(path: Path, results: RobustnessReport): String = FileName.suffix(path) match
    case "html" => RobustnessPage.html(results)
    case "json" => RobustnessData.json(results)
    case _ =>
      val table = RobustnessText.markdown(results)
      if Files.isRegularFile(path) then
        RobustnessCommand.replaceTable(Files.readString(path), table)
      else table

object RobustnessCommand:
  private final val Begin = "<!-- robustness: begin -->"
  private final val End = "<!-- robustness: end -->"

  /** The page with the table between its marks, if it has such; else the table alone. */
  private[bench] def replaceTable(page: String, table: String): String =
    val (begin, end) = (page.indexOf(Begin), page.indexOf(End))
    if begin < 0 || end < begin then table
    else page.take(begin + Begin.length) + s"\n\n$table\n" + page.drop(end)

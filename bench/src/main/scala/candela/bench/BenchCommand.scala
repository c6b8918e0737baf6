package candela.bench

import candela.base.Version
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{FileName, ForeignFile, ForeignKind, SceneFolder, Scratch, WholeFile}
import java.lang.management.ManagementFactory
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.Locale

import scala.jdk.CollectionConverters.*
import scala.util.Using

import candela.bench.peers.PeerSuite
import candela.bench.report.{SuiteChart, SuiteData, SuitePage, SuiteReport}
import candela.bench.statistics.SeedNoise
import candela.bench.suite.{Suite, SuiteFile, SuiteFolder, SuiteResults}
import candela.cli.files.{FileRegister, Output, OutputFiles}
import candela.cli.options.{CommandRow, CommandService, IdleOptions, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.job.SceneFormat
import candela.render.Cancellation

/** `candela bench`, as the program looks it up. */
final class BenchService extends CommandService:
  def row: CommandRow = BenchTable.row

  override def idle: Options => Vector[String] = o =>
    val settings = BenchOptions.of(o)
    val isPage = o.reports.isEmpty || o.reports.exists(_.toLowerCase(Locale.ROOT).endsWith(".html"))
    IdleOptions.idle("no-pictures", ": only .html files have pictures")(
      !settings.pictures && !isPage
    ) ++ IdleOptions.idle("references", ": a suite names its own")(
      settings.references.isDefined && o.files.forall(_.toLowerCase(Locale.ROOT).endsWith(".conf"))
    )

  def run(options: Options, terminal: Terminal, report: Report): ExitCode =
    BenchCommand(options, terminal, report).run()

/** `candela bench`: measures error against time for one or more renderers. */
final class BenchCommand(options: Options, terminal: Terminal, report: Report):
  private val settings = BenchOptions.of(options)
  private val cancellation = Cancellation()

  def run(): ExitCode = report.guarded(inScratch(compared(_)))

  private def compared(scratch: Path): ExitCode =
    val source = options.files.headOption.map(OutputFiles.path)
    val paths = reports(source)
    paths.foreach(checkFolder)
    val fullSuite = source.fold(short(scratch))(read)
    val register = FileRegister()
    register.read(source.toVector ++ fullSuite.scenes.flatMap(s => s.files.values ++ s.reference))
    register.write(Output(paths, "report", options.files.headOption.getOrElse("--peers"), "report"))
    val chosen = fullSuite.restricted(Vector.empty, settings.scenes)
    val peers =
      if settings.peers then PeerSuite.of(chosen, sys.env, scratch)
      else PeerSuite(chosen, Vector.empty)
    val suite = peers.suite.restricted(settings.programs, Vector.empty)
    val expanded = if settings.denoise then suite.withDenoised else suite
    val configured = settings.work.fold(expanded)(work => expanded.copy(work = work))
    terminal.interrupts.during(cancellation):
      val results = measured(seeded(withoutOwnWork(configured)), peers.leftOut, paths, scratch)
      if results.scenes.nonEmpty then
        write(paths, results)
        for path <- paths do terminal.out.println(s"wrote $path")
        terminal.out.flush()
      else if cancellation.isRequested then
        if !options.quiet then terminal.err.println(BenchCommand.nothing(configured))
      else
        // Else they are told already
        val reasons = Option.when(options.quiet):
          results.leftOut.map((what, why) => s"$what: $why").mkString("; ")
        val message = "no program could run any scene"
        throw SceneError(Problem.general(Code.NoProgram, message, reasons.filter(_.nonEmpty)))
      if cancellation.isRequested then ExitCode.Interrupted else ExitCode.Done

  private def short(scratch: Path): Suite =
    if settings.peers then PeerSuite.short(scratch)
    else
      val help = Some("or --peers, which has a suite of its own")
      throw SceneError(Problem.general(Code.SuiteFile, "no suite is named", help))

  private def measured(
      suite: Suite,
      leftOut: Vector[(String, String)],
      paths: Vector[Path],
      scratch: Path
  ): SuiteReport =
    val log: String => Unit = if options.quiet then _ => () else terminal.err.println(_)
    SuiteResults.of(
      suite,
      self,
      scratch,
      Version.current,
      log,
      () => cancellation.isRequested,
      write(paths, _),
      leftOut
    )

  /** Each file is written whole, so an interrupted run leaves the previous version. */
  private def write(paths: Vector[Path], results: SuiteReport): Unit =
    OutputFiles.writeAll(paths): path =>
      WholeFile.write(path, text(path, results).getBytes(UTF_8))

  private def read(source: Path): Suite =
    if Files.isDirectory(source) then
      SuiteFolder.read(source, settings.references.fold(source)(folder))
    else if Files.isRegularFile(source) then
      if settings.peers && SceneFormat.named(source).isDefined then SuiteFolder.ofScene(source)
      else
        for other <- notSuite(source) do
          val help = "a suite is a .conf file, or a folder of scenes with references"
          throw SceneError(Problem.general(
            Code.SuiteFile,
            s"`$source` is $other, not a suite",
            Some(help)
          ))
        SuiteFile.read(source)
    else throw missing("suite", source)

  private def folder(name: String): Path =
    val path = OutputFiles.path(name)
    if !Files.isDirectory(path) then throw missing("folder", path)
    path

  private def missing(what: String, path: Path): SceneError =
    val message = s"no such $what: `$path`"
    SceneError(Problem.general(Code.SuiteFile, message, SceneFolder.suggestionFor(path)))

  private def notSuite(file: Path): Option[String] =
    if SceneFormat.named(file).isDefined then Some("a scene")
    else ForeignFile.of(file).filter(_.kind != ForeignKind.Suite).map(_.what)

  private def seeded(suite: Suite): Suite = settings.seeds.fold(suite)(n => suite.copy(seeds = n))

  /** Sample counts and budgets on the command line apply to all scenes. */
  private def withoutOwnWork(suite: Suite): Suite =
    if settings.work.isEmpty then suite
    else suite.copy(scenes = suite.scenes.map(_.copy(work = None)))

  /** Default without `--report`: an HTML page in the current folder, named after the suite. */
  private def reports(source: Option[Path]): Vector[Path] =
    val name = source.fold("peers")(_.toAbsolutePath.getFileName.toString.stripSuffix(".conf"))
    val names = if options.reports.isEmpty then Vector(s"$name.html") else options.reports
    names.map(OutputFiles.path).distinct

  private def checkFolder(path: Path): Unit =
    val formats = Vector("html", "json", "csv", "svg")
    if !formats.contains(FileName.suffix(path)) then
      val help = Some("results are written as .html, .json, .csv, or .svg (the main charts)")
      throw SceneError(Problem.general(Code.UnknownFormat, s"can't write `$path`", help))
    for problem <- FileRegister.obstacle(path) do throw SceneError(problem)

  private def text(path: Path, results: SuiteReport): String = FileName.suffix(path) match
    case "html" => SuitePage.html(results, settings.pictures)
    case "json" => SuiteData.json(results)
    case "csv" => SuiteData.csv(results)
    case _ => SuiteChart.svg(results)

  /** The command that starts this program: the launcher if known, because it chooses JVM options
    * per scene; otherwise the same Java with the same options and class path.
    */
  private def self: Vector[String] =
    sys.props.get("candela.launcher").filter(l => Files.isExecutable(Path.of(l)))
      .fold(sameJava)(Vector(_))

  private def sameJava: Vector[String] =
    val java = Path.of(System.getProperty("java.home"), "bin", "java").toString
    val runtime = ManagementFactory.getRuntimeMXBean
    val flags = runtime.getInputArguments.asScala.toVector
      .filterNot(f => f.startsWith("-agentlib") || f.startsWith("-javaagent"))
    (java +: flags) ++ Vector("-cp", classPath(runtime.getClassPath), "candela.cli.Main")

  /** Absolute paths, because the programs run in another folder. */
  private def classPath(path: String): String =
    val separator = java.io.File.pathSeparator
    path.split(separator).map(p => Path.of(p).toAbsolutePath.toString).mkString(separator)

  private def inScratch[A](body: Path => A): A =
    Using.resource(Scratch.create())(scratch => body(scratch.folder))

object BenchCommand:
  /** Where the runs so far tell no error. */
  private def nothing(suite: Suite): String =
    val hint =
      if suite.scenes.forall(_.reference.isDefined) then ""
      else s"; without a reference, errors are known from ${SeedNoise.Fewest} seeds on"
    s"nothing written: no scene has results yet$hint"

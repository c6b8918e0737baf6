package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.io.FileName
import candela.cli.files.{FileRegister, FilmKeeping, Output, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, ProgressLine, Report, Terminal}
import candela.image.OutputFormat
import candela.job.{FilmHeaders, FilmKeeper, Prepared, ReferenceFile, Render, SceneLoader}
import candela.measure.ReferenceMean
import candela.render.storage.FilmFile
import candela.render.{Cancellation, RenderControl, Rendering, RenderListener}
import candela.scenefile.SceneFiles
import candela.settings.RenderSettings

import java.nio.file.{Files, Path}

import scala.util.Using

/** `candela reference`: the mean of independent renderings, until its own error is low enough. */
final class ReferenceCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  private val cancellation = Cancellation()
  private val goal = options.settings.goal
  private val scene = options.files.head
  private val perRun = options.control.samples.getOrElse(ReferenceFile.UsualSamples)
  private lazy val path = output
  private lazy val file = ReferenceFile(path, options.settings, scene, perRun)
  private var seconds, ofLast = 0.0

  def run(): ExitCode = report.guarded:
    val register = FileRegister()
    if options.control.limits.sandbox then
      register.confine(Vector(Option(path.getParent).getOrElse(Path.of(""))))
    register.read(Vector(OutputFiles.path(scene)))
    register.check(Output(Vector(path), "reference", scene, isRewritten = true))
    terminal.interrupts.during(cancellation):
      val start = loaded(0): prepared =>
        reportWarnings(prepared)
        register.read(SceneFiles.of(prepared.description))
        register.write(Output(Vector(path), "reference", scene, isRewritten = true))
        file.start(prepared)
      for mean <- start if !options.quiet do
        terminal.err.println(s"continuing $path: ${described(mean)}")
      val result = continued(start)
      if !result.exists(isEnough) then terminal.interrupts.checkTime()
      ended(result, isNew = result.map(_.runs) != start.map(_.runs))

  /** The file of `--outfile`; by default, named after the scene. */
  private def output: Path =
    def beside =
      val name = OutputFiles.ofName(scene, Path.of("")).paths.head
      name.resolveSibling(s"${FileName.stem(name)}-reference.${OutputFormat.default.suffix}")
    val target = options.outfiles.headOption.fold(beside)(OutputFiles.path)
    if !OutputFormat.of(target).contains(OutputFormat.default) then
      val help = Some("only .exr files hold the reference's own error")
      throw SceneError(Problem.general(Code.UnknownFormat, s"can't write `$target`", help))
    target

  private def loaded[A](run: Int)(body: Prepared => A): A =
    val control = options.building.copy(samples = Some(perRun))
    Using.resource(loader.load(scene, settings(run), control))(body)

  private def settings(run: Int): RenderSettings = file.settings(run)

  private def reportWarnings(prepared: Prepared): Unit =
    val warnings = prepared.warnings ++ Option.when(prepared.plan.method.blurs):
      val message = "the integrator blurs: the error of the reference does not show this bias"
      Problem(Code.OptionMisfit, Severity.Warning, None, message)
    report.warnings(warnings, all = options.verbose)
    if options.verbose then Explanation.print(prepared.plan, terminal.err)

  private def continued(start: Option[ReferenceMean]): Option[ReferenceMean] =
    var mean = start
    var isCut = false
    while !isCut && !mean.exists(isEnough) && !cancellation.isRequested do
      val number = mean.fold(0)(_.runs)
      loaded(number): prepared =>
        val film = FileName.withSuffix(path, s"run-${number + 1}.${FilmFile.Suffix}")
        val rendering = rendered(prepared, film, number)
        isCut = !rendering.isComplete
        if !isCut then
          val image = prepared.plan.development(rendering.film, pool = prepared.pool).toRgb
          val next = mean.fold(ReferenceMean.of(image))(_.and(image))
          file.write(next, prepared, rendering)
          // Only now, when the file has what they hold
          for old <- Vector(film, FilmFile.previous(film)) do
            val _ = Files.deleteIfExists(old)
          mean = Some(next)
          if !options.quiet && Integer.bitCount(next.runs) == 1 && !isEnough(next) then
            terminal.err.println(described(next))
    mean

  /** One run; what an interrupted one has rendered is kept in a film file. */
  private def rendered(prepared: Prepared, film: Path, run: Int): Rendering =
    // A film of other runs must not go on as this one
    val header = FilmHeaders.of(settings(run), scene, prepared, film).copy(samples = perRun)
    def warn(problem: Problem) = report.warnings(Vector(problem), all = true)
    val keeperOptions = FilmKeeper.How(options.film.every, warn)
    val progress = ProgressLine(terminal.err, terminal.isInteractive, terminal.isReadByProgram)
    Using.resource(FilmKeeper.of(film, header, keeperOptions)(FilmKeeping.locked(film))): keeper =>
      val progressListener = Option.when(!options.quiet)(RenderListener.onProgress(progress.update))
      val control = RenderControl(
        options.control.threads,
        cancellation,
        RenderListener.all(progressListener),
        checkpointer = Some(keeper.checkpointer())
      )
      val rendering =
        try Render.render(prepared, control)
        finally progress.finish()
      ofLast = rendering.seconds
      seconds += ofLast
      rendering

  private def isEnough(mean: ReferenceMean): Boolean =
    val isGood = mean.runs >= ReferenceFile.MinRuns &&
      goal.error.exists(most => mean.relativeError.exists(_ <= most))
    isGood || goal.time.exists(_ < seconds + ofLast / 2)

  private def described(mean: ReferenceMean): String =
    val error = mean.relativeError.fold("error unknown before the second run"): e =>
      s"relative error ${Figures.percentage(e)}"
    s"${Figures.count(mean.runs, "run")} of $perRun samples per pixel, $error"

  private def ended(result: Option[ReferenceMean], isNew: Boolean): ExitCode =
    val isCut = cancellation.isRequested && !result.exists(isEnough)
    if !options.quiet then
      val again = "; the same command continues"
      val line = result match
        case Some(mean) if isCut => s"interrupted: $path has ${described(mean)}$again"
        case Some(mean) => s"${if isNew then "wrote" else "kept"} $path  ${described(mean)}"
        case None => s"interrupted in the first run$again"
      terminal.out.println(line)
      terminal.out.flush()
    if isCut then ExitCode.Interrupted else ExitCode.Done

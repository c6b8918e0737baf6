package candela.cli.rendering

import candela.diagnostics.{Problem, SceneError, Severity}
import candela.cli.files.Denoised
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, ProblemText, ProgressLine, Terminal, Thumbnail}
import candela.image.Image
import candela.job.{
  Denoising, ErrorRecorder, FilmKeeper, GoalRule, MissedGoal, Prepared, Render, StrategyFiles
}
import candela.render.{Cancellation, Looks, RenderControl, Rendering, RenderListener, StoppingRule}
import candela.render.storage.Checkpoints

import java.nio.file.Path

/** The rendering of one scene: its images, its film, and all that follows it.
  *
  * @param keeping the film to write, if any
  */
private[cli] final class SceneRun(
    options: Options,
    terminal: Terminal,
    prepared: Prepared,
    writer: ImageWriter,
    keeping: Option[FilmKeeper],
    cancellation: Cancellation
):
  private val plan = prepared.plan
  private val settings = options.settings
  private val isPreview = settings.preview
  private val denoises = settings.output.denoise

  private val reporting =
    Option.when(options.reports.nonEmpty)(Reporting(options, writer.name, prepared))
  private val errorLog = ErrorLog.of(plan)
  private val recorder: Option[ErrorRecorder] = reporting.map(_.recorder).orElse:
    val isEstimated = !options.quiet && !isPreview && options.film.shard.isWhole
    val estimates = if settings.goal.isGiven then Looks.Waves else Looks.Doublings
    Option.when(settings.goal.isGiven || isEstimated):
      ErrorRecorder(plan.development, None, estimates)
  private val goal = recorder.filter(_ => settings.goal.isGiven)
    .map: recorder =>
      // A reference tells another error than the saved one, which is estimated
      val earlier = keeping.filter(_ => options.reference.isEmpty)
        .flatMap(k => k.savedError(k.samplesDone))
      GoalRule(settings.goal, plan.samplesPerPixel, recorder, isPreview, earlier, plan.isLimited)
  private val reference =
    options.reference.filter(_ => denoises).map(RenderRecorder.fitting(plan, _))

  def run(): ExitCode = terminal.interrupts.during(cancellation):
    val progress = ProgressLine(terminal.err, terminal.isInteractive, terminal.isReadByProgram)
    val checkpoints = keeping.map(_.checkpointer(n => recorder.flatMap(_.relativeMse(n))))
    val watching = Option.when(options.isWatched)(watched())
    try
      val rendering = rendered(progress, checkpoints, watching)
      watching.foreach(_.end(rendering))
      reporting.foreach(_.recorder.ended(rendering))
      val result = results(rendering)
      val films = keeping.map(_.path)
        .filter(_ => writer.paths.isEmpty && checkpoints.forall(_.failure.isEmpty))
      val (files, failures) = announce(result, films.toVector)
      watching.foreach(_.await(files))
      // The warning of it is not printed with --quiet
      val unsaved =
        for k <- keeping; c <- checkpoints if options.quiet && c.failure.nonEmpty
        yield FilmKeeper.unwritable(k.path, c.failure).copy(severity = Severity.Error)
      val problems = failures ++ errorLog.toVector.flatMap(_.failure) ++ unsaved
      if problems.nonEmpty then throw SceneError(problems)
      if !result.isComplete || checkpoints.exists(_.failure.nonEmpty) then ExitCode.BadInput
      else if !rendering.isComplete && !(isLate && result.hasAll) then ExitCode.Interrupted
      else ExitCode.Done
    finally watching.foreach(_.close())

  private def rendered(
      progress: ProgressLine,
      checkpoints: Option[Checkpoints],
      watching: Option[Watching]
  ): Rendering =
    val update = terminal.follow.getOrElse(progress.update)
    val progressListener = Option.when(!options.quiet)(RenderListener.onProgress(update))
    val followed = watching.map(w => RenderListener.onStart(w.start))
    val images = Option.when(options.partialImages)(PartialImages(save(_): Unit))
    val estimating = recorder.filter(_ => goal.isEmpty)
    val listeners = estimating ++ progressListener ++ errorLog ++ images ++ followed
    val control = RenderControl(
      options.control.threads,
      cancellation,
      RenderListener.all(listeners),
      options.film.shard,
      checkpoints,
      goal.getOrElse(StoppingRule.Never)
    )
    try Render.render(prepared, control)
    finally progress.finish()

  /** What was rendered, and the files of it.
    *
    * @param wanted  images that it may replace
    * @param written those that could be written
    */
  private final case class Result(
      rendering: Rendering,
      image: Image,
      wanted: Vector[Path],
      written: Vector[Path],
      denoised: Option[Denoised],
      developSeconds: Double,
      writeSeconds: Double
  ):
    def isComplete: Boolean = written.size == wanted.size

    /** Whether no older image was kept. */
    def hasAll: Boolean = wanted.size == writer.paths.size

  private def results(rendering: Rendering): Result =
    val started = System.nanoTime
    val image = writer.image(rendering)
    val finished = System.nanoTime
    val developSeconds = (finished - started) * 1e-9
    val denoised = Option.when(denoises)(Denoised(image, rendering.seconds, developSeconds))
    val wanted = writer.writable(rendering)
    val written = writer.write(wanted, rendering, image)
    val writeSeconds = (System.nanoTime - finished) * 1e-9
    Result(rendering, image, wanted, written, denoised, developSeconds, writeSeconds)

  /** Tells of the result, and writes the reports.
    *
    * @return all files, and what is wrong with those that can't be written
    */
  private def announce(result: Result, films: Vector[Path]): (Vector[Path], Vector[Problem]) =
    import result.*
    val isPrinted = !options.quiet
    if wanted.size < writer.paths.size && isPrinted then
      terminal.err.println(Summary.unreplaced(writer.paths.diff(wanted), rendering, isLate))
    val files = written ++ films
    val develops = if denoised.isEmpty then "develop" else "develop and denoise"
    val after = Vector(develops -> developSeconds, "write" -> writeSeconds)
    val noise =
      for r <- recorder if !isPreview
      yield
        val samples = rendering.samplesDone
        r.errorAt(samples) match
          case None =>
            // A film that is complete already, of which nothing is measured anew
            val saved = keeping.flatMap(_.savedError(samples))
            Summary.noise(samples, saved.map(i => Math.sqrt(i.estimate)), saved)
          case known => Summary.noise(samples, known, r.interval(samples))
    val ending =
      goal.filter(_ => rendering.isComplete && !isPreview).map(_.endedBy(rendering).setting)
    Summary.print(
      options,
      terminal,
      files,
      prepared,
      rendering,
      after,
      isLate,
      noise.getOrElse(""),
      ending
    )
    writer.warnIfEmpty(rendering, image)
    // A preview has neither goals nor options of its own to reach them
    val missed = goal.filterNot(_ => isPreview).flatMap(MissedGoal.problem(_, rendering))
    missed.foreach(ProblemText.print(_, terminal.err, hasColor = false))
    for log <- errorLog; remark <- log.remark if isPrinted do terminal.err.println(remark)
    val threads = options.control.threads
    val (pages, failures) = reporting.fold((Vector.empty, Vector.empty)):
      _.write(rendering, threads, developSeconds, writeSeconds, denoised)
    for path <- pages if isPrinted do terminal.out.println(s"wrote $path")
    terminal.out.flush()
    for r <- reference; d <- denoised if isPrinted do
      terminal.out.println(s"error  ${d.errors(r)}")
    for kind <- options.thumbnail do
      val displayed = Denoising.displayed(image)
      terminal.out.control(Thumbnail.of(displayed, options.display, kind, terminal))
    terminal.out.flush()
    (files ++ pages, failures)

  /** Whether a rendering that did not end by itself ended by its time, and not by its user. */
  private def isLate: Boolean = settings.goal.time.isDefined && !cancellation.isRequested

  private def watched(): Watching =
    val reference = options.reference.map(RenderRecorder.fitting(plan, _))
    def saved(rendering: Rendering) =
      if writer.writable(rendering).isEmpty then
        "nothing: the new image has less than 1 sample per pixel"
      else StrategyFiles.listed(save(rendering))
    Watching(options, writer.name, prepared, reference, cancellation, terminal, saved)

  /** Writes the image so far. */
  private def save(rendering: Rendering): Vector[Path] =
    writer.write(writer.writable(rendering), rendering, writer.image(rendering))

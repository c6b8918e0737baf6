package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.Scratch
import candela.cli.files.{FilmKeeping, Frame, OutputFiles, Sequence}
import candela.cli.options.{FilmOptions, Options}
import candela.cli.rendering.ImageWriter
import candela.cli.terminal.{ExitCode, ProgressLine, Report, Terminal}
import candela.job.{
  Cluster, ClusterFailure, ClusterRun, ClusterWork, FilmHeaders, Prepared, SceneLoader,
  ShardRenderer
}
import candela.render.{Cancellation, Outlook, Progress, RenderState}
import candela.render.storage.FilmHeader
import candela.scenefile.SceneFiles

import java.nio.file.Path
import java.util.concurrent.locks.LockSupport

import scala.util.Using

/** `candela render --spark MASTER`: renders on a cluster, some scenes at a time. Each image is
  * written when it is finished.
  */
private[cli] final class ClusterCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  import ClusterCommand.*
  private val renderer = RenderCommand(options, terminal, report, loader)
  private val cancellation = Cancellation()
  private val progress =
    ProgressLine(terminal.err, terminal.isInteractive, terminal.isReadByProgram)
  private val started = System.nanoTime
  private val sequence = Sequence(options)
  private var open = Vector.empty[Submitted]
  private var samplesDone, samplesAsked = 0L
  private var history = Vector.empty[(Double, Long)] // seconds, and samples until then

  def run(): ExitCode =
    val code = guarded:
      renderer.checkAll(sequence.frames)
      terminal.interrupts.during(cancellation):
        val master = options.cluster.master.mkString
        Using.resource(Cluster.connect(master, note, terminal.environment)): cluster =>
          for frame <- renderer.present(sequence) if !cancellation.isRequested do
            while open.size >= AtOnce do finishOne()
            start(frame, cluster)
          while open.nonEmpty do finishOne()
          if options.verbose then note(cluster.summary)
          ExitCode.Done
    if !options.quiet && !cancellation.isRequested then
      sequence.summary.foreach(terminal.out.println)
    terminal.out.flush()
    sequence.code.worseOf(code)

  private def guarded(body: => ExitCode): ExitCode =
    report.guarded:
      try body
      catch
        case e: ClusterFailure =>
          val lines = e.getMessage.split("\n", 2)
          val help = lines.lift(1).map(_.linesIterator.map(_.strip).mkString("; "))
          throw SceneError(Problem.general(Code.Cluster, lines.head, help))

  private def note(text: String): Unit = if !options.quiet then terminal.err.println(text)

  private def start(frame: Frame, cluster: Cluster): Unit =
    val openCount = open.size
    val code = guarded:
      submit(frame, cluster)
      ExitCode.Done
    if open.size == openCount then sequence.ended(frame.label)(code)

  /** Sends a scene to the cluster, unless its image is done. */
  private def submit(frame: Frame, cluster: Cluster): Unit =
    val prepared = renderer.load(frame)
    if prepared.description.isFollowed then
      val message = s"`${frame.scene}` has several images; --spark renders one"
      val help = Some("choose one, as --sensor 0 does; or render without --spark")
      throw SceneError(Problem.general(Code.OptionMisfit, message, help))
    val numbered = renderer.numbered(frame, prepared, 0)
    val Frame(scene, outfiles, options, _) = numbered
    val writer = renderer.images(numbered, prepared)
    val film = outfiles.find(FilmOptions.isFilm).map(OutputFiles.path)
    if writer.isDone then
      prepared.close()
      sequence.skip()
    else
      val path = film.getOrElse(Path.of("film"))
      val header = FilmHeaders.of(options.settings, scene, prepared, path, writer.paths)
      val total = prepared.plan.sampled.pixels * header.samples
      val files = SceneFiles.of(prepared.description)
      val work = ClusterWork(header, Path.of(scene), files, options.cluster.shards, total)
      samplesAsked += total
      open :+= Submitted(frame.label, prepared, writer, film, work, cluster.submit(work))

  /** Waits for one of the renderings, and writes its image. */
  private def finishOne(): Unit =
    while !open.exists(_.run.isDone) do
      updateProgress()
      if cancellation.isRequested then open.foreach(_.run.cancel())
      LockSupport.parkNanos(Tick)
    progress.finish()
    for next <- open.find(_.run.isDone) do
      open = open.filterNot(_ eq next)
      samplesDone += next.work.total
      sequence.ended(next.label)(guarded(finish(next)))
      next.prepared.close()

  private def updateProgress(): Unit =
    if !options.quiet then
      val seconds = (System.nanoTime - started) * 1e-9
      val sampleCount = samplesDone + open.map(s => Math.min(s.run.samples, s.work.total)).sum
      history = history.dropWhile((at, _) => at < seconds / 2) :+ (seconds, sampleCount)
      val (since, before) = history.head
      val rate = Option((sampleCount - before) / (seconds - since)).filter(r => r > 0 && r.isFinite)
      val remaining = rate.map((samplesAsked - sampleCount) / _).filter(_ => seconds > FirstSeconds)
      progress.update(Progress(sampleCount, samplesAsked, seconds, Outlook(remaining, rate)))

  private def finish(submitted: Submitted): ExitCode =
    terminal.interrupts.checkTime()
    Using.resource(Scratch.create()): scratch =>
      val (films, _) = ShardRenderer.distinct(submitted.run.films(scratch.folder))
      val header = submitted.work.header.merging(films.map(_.header))
      def load(state: RenderState): Unit =
        films.foreach(_.load(state))
        for path <- submitted.film do
          save(path, header.joined, state)
      val rendering = submitted.prepared.gather(load)
      val done = rendering.copy(
        samplesDone = FilmHeader.averageDone(films.map(_.header)),
        samplesPerPixel = header.samples
      )
      renderer.finish(submitted.writer, submitted.prepared, done)
        .worseOf(if done.isComplete then ExitCode.Done else ExitCode.Interrupted)

  private def save(path: Path, header: FilmHeader, state: RenderState): Unit =
    Using.resource(FilmKeeping.locked(path)): _ =>
      Prepared.write(header, state, path)
    if !options.quiet then terminal.out.println(s"wrote $path")

private[cli] object ClusterCommand:
  /** Renderings in the cluster: the next ones take over where the first leaves machines idle. */
  val AtOnce = 3

  /** In nanoseconds. */
  val Tick = 100_000_000L

  /** In which machines start. */
  val FirstSeconds = 10.0

  final case class Submitted(
      label: String,
      prepared: Prepared,
      writer: ImageWriter,
      film: Option[Path],
      work: ClusterWork,
      run: ClusterRun
  )

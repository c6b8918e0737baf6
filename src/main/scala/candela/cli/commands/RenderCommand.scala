package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.{InputFile, Keep}
import candela.cli.files.{FileRegister, FilmKeeping, Frame, OutputFiles, Sequence}
import candela.cli.options.Options
import candela.cli.rendering.{CostRows, ImageWriter, RenderOutputs, SceneRun, Summary}
import candela.cli.terminal.{ExitCode, Printer, Report, StageLine, Terminal, Thumbnail}
import candela.image.Oidn
import candela.job.{Denoising, FilmKeeper, Prepared, SceneLoader}
import candela.render.{Cancellation, RenderPlan, Rendering}
import candela.render.storage.FilmFile
import candela.scene.PathReport
import candela.settings.{BuildStages, RenderRegion}

import java.nio.file.Path

import scala.util.Using

/** `candela render`: renders scenes to image files.
  *
  * @param resumed  the saved rendering to continue, if any
  * @param register of files, shared by the renderings of a run
  */
final class RenderCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader,
    resumed: Option[FilmFile] = None,
    register: FileRegister = FileRegister()
):
  private val cancellation = Cancellation()
  private val sequence = Sequence(options)
  private var warned = Set.empty[Problem]
  private val files = RenderOutputs(options, report, register, resumed)
  private lazy val cache =
    val files = options.sceneCache
    if options.keepsScenes && files.isEmpty then
      val help = Some("name one: --scene-cache FOLDER")
      val message = "--scene-cache needs a folder: this system has no cache folder"
      throw SceneError(Problem.general(Code.OptionMisfit, message, help))
    if files.nonEmpty || sequence.frames.size > 1 then Keep(files) else Keep.Nothing
  private lazy val denoising = Option.when(options.settings.output.denoise):
    Denoising(Oidn.load(terminal.environment), options.control.threads)

  def run(): ExitCode =
    val code = report.guarded:
      checkAll(sequence.frames)
      ExitCode.Done
    if code == ExitCode.Done then run(sequence) else code

  /** @throws SceneError if two scenes have one image */
  private[cli] def checkAll(frames: Vector[Frame]): Unit = files.checkAll(frames, loader)

  private def run(sequence: Sequence): ExitCode =
    for frame <- present(sequence) do
      // Files of v2 and v3 may have several worlds
      var world = Option(0)
      while world.nonEmpty && !cancellation.isRequested do
        val n = world.get
        world = None
        sequence.ended(frame.label):
          report.guarded:
            Using.resource(load(frame, n)): prepared =>
              if isLookedAt then inspect(prepared)
              else
                val files = numbered(frame, prepared, n).outfiles
                world = Option.when(prepared.description.isFollowed)(n + 1)
                render(frame, prepared, files, sequence)
    if !options.quiet && !cancellation.isRequested then
      sequence.summary.foreach(terminal.out.println)
    terminal.out.flush()
    sequence.code

  /** Those of several scenes that are there. Missing ones fail before the others are rendered. */
  private[cli] def present(sequence: Sequence): Vector[Frame] =
    if sequence.frames.size == 1 then sequence.frames
    else
      sequence.frames.filter: frame =>
        val code = report.guarded:
          loader.checkExists(frame.scene)
          ExitCode.Done
        if code != ExitCode.Done then sequence.ended(frame.label)(code)
        code == ExitCode.Done

  /** With the names of the files of a world. */
  private[cli] def numbered(frame: Frame, prepared: Prepared, world: Int): Frame =
    frame.copy(outfiles =
      Sequence.ofWorld(
        frame.scene,
        frame.outfiles,
        options.settings.reading,
        world,
        prepared.description.isFollowed
      )
    )

  private[cli] def load(frame: Frame, world: Int = 0): Prepared =
    val Frame(scene, outfiles, options, _) = frame
    if world > 0 then
      for why <- InputFile.obstacle(OutputFiles.path(scene)) do
        val message = s"can't read world ${world + 1} of `$scene`: $why"
        val help = Some("write the scene to a file first")
        throw SceneError(Problem.general(Code.Unreadable, message, help))
    // Warns before parsing, which may take long.
    files.check(scene, outfiles)
    for kind <- options.thumbnail do Thumbnail.kind(kind, terminal): Unit
    denoising.foreach(identity)
    val stages = if options.quiet then BuildStages.Silent else StageLine(terminal)
    val control = options.building.copy(
      world = Option.when(terminal.passing.isEmpty)(world),
      cache = cache,
      stages = stages
    )
    val prepared = loader.load(scene, options.sceneSettings, control)
    // A first look ignores most of what warnings are about.
    val isBrief = options.settings.preview && !options.verbose
    val reported =
      if isBrief then prepared.warnings.filter(_.standIn.nonEmpty) else prepared.warnings
    // Images of one scene have most of them in common
    report.warnings(reported.filterNot(warned), all = options.verbose)
    warned ++= reported
    if !options.quiet && world == 0 then
      for added <- prepared.description.additions do terminal.err.println(s"$scene: $added")
    if options.explain || options.verbose then Explanation.print(prepared.plan, terminal.err)
    prepared

  /** Whether something of the scene is printed, and nothing rendered. */
  private def isLookedAt: Boolean = options.debug || options.pixelMaterial.isDefined

  private def inspect(prepared: Prepared): ExitCode = options.pixelMaterial match
    case Some((x, y)) if !options.debug => PixelMaterial.run(prepared.plan, x, y, terminal.out)
    case _ => PixelTrace.run(prepared, options, terminal.out)

  private def render(
      frame: Frame,
      prepared: Prepared,
      outfiles: Vector[String],
      sequence: Sequence
  ): ExitCode =
    val options = frame.options
    val paths = files.images(frame.scene, prepared, outfiles)
    val name = resumed.fold(frame.scene)(_.header.scene)
    val lasting = paths.filterNot(terminal.passing.contains)
    val keeping = FilmKeeping.of(options, report, name, prepared, outfiles, lasting, resumed)
    try
      val writer = this.writer(options, name, prepared, paths)
      if isDone(writer, keeping) then
        sequence.skip()
        ExitCode.Done
      else
        for k <- keeping; film <- k.start if !options.quiet do
          terminal.err.println(Summary.continues(film))
        SceneRun(options, terminal, prepared, writer, keeping, cancellation).run()
    finally keeping.foreach(_.close())

  private def isDone(writer: ImageWriter, keeping: Option[FilmKeeper]): Boolean =
    writer.isDone ||
      (options.film.skipDone && writer.paths.isEmpty && !options.settings.isEndless &&
        keeping.exists(_.isDone))

  /** The images of a scene that is rendered elsewhere.
    *
    * @throws SceneError if one can't be written
    */
  private[cli] def images(frame: Frame, prepared: Prepared): ImageWriter =
    val paths = files.images(frame.scene, prepared, frame.outfiles)
    writer(frame.options, frame.scene, prepared, paths)

  /** Likewise, if they are known to be writable. */
  private[cli] def writer(
      options: Options,
      scene: String,
      prepared: Prepared,
      paths: Vector[Path]
  ): ImageWriter =
    ImageWriter(options, report, denoising, scene, prepared, paths)

  /** Writes the image of a rendering that was put together from film files; one without samples
    * replaces none.
    */
  private[cli] def finish(
      writer: ImageWriter,
      prepared: Prepared,
      rendering: Rendering
  ): ExitCode =
    val wanted = writer.writable(rendering)
    val image = writer.image(rendering)
    val written = writer.write(wanted, rendering, image)
    if wanted.size < writer.paths.size then
      terminal.err.println(Summary.unreplaced(writer.paths.diff(wanted), rendering))
    Summary.print(options, terminal, written, prepared, rendering)
    writer.warnIfEmpty(rendering, image)
    if written.size < writer.paths.size then ExitCode.BadInput else ExitCode.Done

/** Prints the features of a plan, one line each: the choices that the builder made. */
object Explanation:
  def print(plan: RenderPlan, to: Printer): Unit =
    val rows = plan.features ++ CostRows.of(plan.costs)
    val width = rows.map(_._1.length).max
    for (what, value) <- rows do to.println(s"  ${what.padTo(width, ' ')}  $value")

/** `candela render --pixel x,y --sample n --debug`: traces one sample and logs its path. */
private[cli] object PixelTrace:
  def run(prepared: Prepared, options: Options, out: Printer): ExitCode =
    val plan = prepared.plan
    val (x, y) = options.settings.region match
      case RenderRegion.Pixel(x, y) => (x, y)
      case _ => (0, 0)
    val crop = plan.crop
    if x < crop.x0 || x >= crop.x1 || y < crop.y0 || y >= crop.y1 then
      val size = s"x in [${crop.x0}, ${crop.x1}), y in [${crop.y0}, ${crop.y1})"
      throw SceneError(Problem.general(
        Code.OptionMisfit,
        s"--pixel $x,$y is outside the image: $size"
      ))
    out.println(s"pixel ($x, $y), sample ${options.sample}")
    prepared.trace(x, y, options.sample, PathReport(out.println)) match
      case Some(light) => out.println(s"contributes $light")
      case None => out.println("discarded: NaN or infinite")
    out.flush()
    ExitCode.Done

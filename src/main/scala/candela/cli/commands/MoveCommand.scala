package candela.cli.commands

import candela.cli.files.OutputFiles
import candela.cli.options.Options
import candela.cli.rendering.Watching
import candela.cli.terminal.{ExitCode, ProblemText, Report, StageLine, Terminal}
import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.WholeFile
import candela.job.{Render, SceneFormat, SceneLoader}
import candela.moving.{CameraOutput, CameraText, Mover}
import candela.render.Cancellation
import candela.report.Frame
import candela.settings.BuildStages
import candela.watch.{MoveView, WatchAddress}

import java.io.IOException
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import scala.util.Using

/** `candela move`: a page on which viewers move the camera of a scene. */
final class MoveCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  private val scene = options.files.head
  private val cancellation = Cancellation()

  def run(): ExitCode = report.guarded:
    val _ = file // refused before the scene is built
    terminal.interrupts.during(cancellation):
      val stages = if options.quiet then BuildStages.Silent else StageLine(terminal)
      val control = options.building.copy(stages = stages)
      Using.resource(loader.load(scene, options.sceneSettings, control)): prepared =>
        report.warnings(prepared.warnings, all = options.verbose)
        if options.explain || options.verbose then Explanation.print(prepared.plan, terminal.err)
        checkOutput(prepared.description.sources)
        val settings = prepared.settings
        Using.resource(Mover(
          prepared,
          description => Render.build(description, settings, control),
          options.control.threads,
          output
        )): mover =>
          val plan = prepared.plan
          val crop = plan.crop
          val address = options.watch.getOrElse(WatchAddress(None, None))
          def view = MoveView(
            scene,
            plan.features,
            Frame(crop.x0, crop.y0, crop.x1, crop.y1),
            plan.samplesPerPixel,
            prepared.warnings.distinct.map(ProblemText.format),
            address,
            mover
          )
          Using.resource(Watching.served(address)(view)): page =>
            terminal.err.println(s"move the camera at ${page.link}")
            page.await(cancellation.isRequested)
      ExitCode.Done

  private lazy val file: Path =
    val name = options.outfiles.headOption
      .getOrElse(s"${SceneFormat.stem(OutputFiles.path(scene).getFileName)}-camera.pbrt")
    OutputFiles.ofText(name, "move writes statements of pbrt", "pbrt")(!_.hasDialects)

  /** Nothing of the scene is written over, but the camera with which it began. */
  private def checkOutput(sources: Vector[Path]): Unit =
    val camera = options.settings.reading.camera.map(Path.of(_))
    def isSame(other: Path) = Files.exists(file) && Files.isSameFile(file, other)
    if sources.filterNot(camera.contains).exists(isSame) then
      val message = s"the camera would be written over `$file`, which is of the scene"
      val help = Some("name another file: --outfile FILE")
      throw SceneError(Problem.general(Code.OutputConflict, message, help))

  private object output extends CameraOutput:
    def name: String = file.toString

    def write(camera: CameraText): String =
      val folder = Option(file.toAbsolutePath.getParent).getOrElse(Path.of(""))
      val text = s"# candela render ${Path.of(scene).getFileName} --camera ${file.getFileName}\n" +
        camera.statementsIn(folder)
      try
        WholeFile.write(file, text.getBytes(UTF_8))
        if !options.quiet then terminal.err.println(s"wrote $file")
        file.toString
      catch case e: IOException => s"failed: ${e.getMessage}"

package candela.cli.commands

import candela.diagnostics.Limit
import candela.io.FileName
import candela.cli.files.{FileRegister, Output, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal, Thumbnail}
import candela.image.OutputFormat
import candela.job.SceneLoader
import candela.settings.RenderGoal

/** `candela preview`: a first look at scenes, within seconds: few pixels, headlight shading, and
  * placeholders for what is missing.
  */
final class PreviewCommand(
    options: Options,
    terminal: Terminal,
    report: Report,
    loader: SceneLoader
):
  import PreviewCommand.*

  def run(): ExitCode =
    val register = FileRegister()
    report.guarded:
      val previews = FileRegister()
      for scene <- options.files do
        val files = OutputFiles.requested(previewOptions(scene).outfiles)
        previews.note(Output(files.paths, "preview", scene))
      val codes = options.files.map: scene =>
        report.guarded(RenderCommand(
          previewOptions(scene), terminal, report, loader, register = register
        ).run())
      codes.foldLeft(ExitCode.Done)(_ worseOf _)

  private def previewOptions(scene: String): Options =
    val picture =
      FileName.withSuffix(OutputFiles.path(scene).getFileName, OutputFormat.preview.suffix)
    val terminalKind =
      Option.when(terminal.isInteractive)(Thumbnail.kindOf(terminal.environment)).flatten
    val limits = options.control.limits.effective
    options.copy(
      files = Vector(scene),
      outfiles =
        if options.outfiles.nonEmpty then options.outfiles
        else
          val name = s"${FileName.stem(picture)}-preview.${OutputFormat.preview.suffix}"
          val isConfined = options.control.limits.sandbox
          Vector(
            if isConfined then OutputFiles.path(scene).resolveSibling(name).toString else name
          )
      ,
      settings = options.settings.copy(
        preview = true,
        samples = Some(limits.getOrElse(Limit.Samples, Samples.toLong).min(Samples).toInt),
        goal = RenderGoal(time = Some(Seconds)),
        reading = options.settings.reading.copy(keepGoing = true)
      ),
      thumbnail = options.thumbnail.orElse(terminalKind)
    )

object PreviewCommand:
  /** Samples per pixel, if there is time. */
  private val Samples = 16

  /** Leaves time to write the picture. */
  private val Seconds = 1.2

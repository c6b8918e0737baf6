package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError}
import java.nio.file.Path

import candela.cli.files.{InputImages, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal, Thumbnail, ThumbnailKind}
import candela.image.*
import candela.job.Denoising

/** `candela view`: shows images in the terminal, or writes them as a picture; several become a
  * contact sheet.
  */
final class ViewCommand(options: Options, terminal: Terminal, report: Report):
  private val display = options.display

  def run(): ExitCode = report.guarded:
    val outputs = OutputFiles.ofImages(options.outfiles)
    outputs.check(options.files, "picture")
    for path <- outputs.paths if !OutputFormat.of(path).exists(_.contents == Contents.Display) do
      val pictures = OutputFormat.listed(Contents.Display)
      throw SceneError(Problem.general(
        Code.UnknownFormat,
        s"`view` writes $pictures, found `$path`"
      ))
    val images = options.files.map(OutputFiles.path).map: path =>
      path -> ImageFiles.colored(
        path,
        ImageEdits.layerAsColors(Denoising.displayed(InputImages.read(path, report)))
      )
    val about = OutputFiles.sources(images.map(_._1))
    images match
      case Vector((_, image)) =>
        write(outputs.paths, image, display, about +: display.describe(image))
      case several =>
        // Each image has an exposure of its own.
        val cells = several.map((path, image) => path.getFileName.toString -> display(image))
        val sheet = ContactSheet(options.columns).of(cells)
        val asItIs = DisplayTransform(bits = display.bits, dithers = display.dithers)
        write(outputs.paths, sheet, asItIs, Vector(about))
    ExitCode.Done

  private def write(
      paths: Vector[Path],
      picture: Image,
      how: DisplayTransform,
      about: Vector[(String, String)]
  ): Unit =
    OutputFiles.writeAll(paths): path =>
      ImageFiles.write(path, picture, about, WriteOptions(display = how))
      if !options.quiet then
        terminal.out.println(s"wrote $path  ${picture.width}x${picture.height}")
    if paths.isEmpty || options.thumbnail.isDefined then
      val kind = options.thumbnail.getOrElse(ThumbnailKind.Auto)
      terminal.out.control(Thumbnail.of(picture, how, kind, terminal))
    terminal.out.flush()

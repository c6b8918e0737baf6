package candela.cli.commands

import candela.base.Figures
import candela.cli.files.{ImageParts, InputImages, OutputFiles}
import candela.cli.options.Options
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.diagnostics.Code
import candela.image.{ImageEdits, ImageError, WriteOptions}
import candela.job.ImageFile

/** `candela average`: the mean of images, such as renderings with different seeds. */
final class AverageCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val outputs = OutputFiles.ofImages(options.outfiles)
    outputs.check(options.files, "mean")
    val window = ImageParts.shared(options.files.map(OutputFiles.path)).fold(
      message => throw ImageError(Code.DifferentImages, message),
      identity
    )
    val images = options.files.iterator.map: name =>
      name -> InputImages.read(OutputFiles.path(name), report).premultiplied
    val mean = ImageEdits.mean(images)
    val writeOptions =
      WriteOptions(isHalf = options.image.isHalf, display = options.display, window = window)
    val about = OutputFiles.sources(options.files.map(OutputFiles.path))
    OutputFiles.writeAll(outputs.paths): out =>
      ImageFile.encoded(out, mean, Vector(about), writeOptions).save()
      if !options.quiet then
        val count = Figures.count(options.files.size, "image")
        terminal.out.println(s"wrote $out  ${mean.width}x${mean.height}, mean of $count")
    terminal.out.flush()
    ExitCode.Done

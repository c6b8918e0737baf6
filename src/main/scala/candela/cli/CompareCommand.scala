package candela.cli

import candela.image.ImageFiles
import candela.measure.Metrics

import java.nio.file.Path

/** `candela compare`: how an image differs from its reference. */
final class CompareCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val Vector(image, reference) = options.files.map(f => ImageFiles.read(Path.of(f))): @unchecked
    val metrics = Metrics.compare(image, reference)
    lines(metrics).foreach(terminal.out.println)
    terminal.out.flush()
    options.maxRelMse.fold(ExitCode.Done)(judge(metrics, _))

  /** Pixels that can't be compared are a failure too: NaN must not pass for equal. */
  private def judge(m: Metrics, limit: Double): ExitCode =
    if m.skipped > 0 then
      terminal.err.println(s"${Figures.count(m.skipped, "pixel")} can't be compared")
      ExitCode.BadInput
    else if m.relativeMse <= limit then ExitCode.Done
    else
      terminal.err.println(
        s"relative MSE ${Figures.scientific(m.relativeMse)} is above --max-relmse $limit"
      )
      ExitCode.BadInput

  private def lines(m: Metrics): Vector[String] =
    val ratios = m.channels.zip(m.meanRatio).map((c, r) => s"$c ${Figures.fixed(r, 4)}")
    val psnr = if m.psnr.isInfinite then "infinite" else s"${Figures.fixed(m.psnr, 2)} dB"
    val difference = Figures.scientific(m.largest.value)
    val most = m.largest
    Vector(
      s"MSE           ${Figures.scientific(m.mse)}",
      s"relative MSE  ${Figures.scientific(m.relativeMse)}",
      s"PSNR          $psnr",
      s"mean ratio    ${ratios.mkString("  ")}",
      s"largest       $difference in ${most.channel} at (${most.x}, ${most.y})"
    ) ++ Option.when(m.skipped > 0):
      s"skipped       ${Figures.count(m.skipped, "pixel")}, NaN or infinite"

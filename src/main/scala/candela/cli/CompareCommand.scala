package candela.cli

import candela.image.{ImageError, ImageFiles}
import candela.measure.{ErrorMap, HeatMap, ImagePair}

import java.nio.file.{Files, Path}

/** `candela compare`: how an image differs from its reference, or a folder of them from theirs. */
final class CompareCommand(options: Options, terminal: Terminal, report: Report):
  private val asked = options.compare

  def run(): ExitCode = report.guarded:
    val Vector(image, reference) = options.files.map(OutputFiles.path): @unchecked
    for name <- asked.difference ++ asked.heatMap do
      OutputFiles.asked(Vector(name)).check()
    val code = if Files.isDirectory(image) then compareSet(image, reference)
    else compareTwo(image, reference)
    terminal.out.flush()
    code

  private def compareTwo(image: Path, reference: Path): ExitCode =
    val comparison = Comparison(pairOf(image, reference))
    comparison.lines.foreach(terminal.out.println)
    if asked.perChannel then comparison.perChannel.foreach(terminal.out.println)
    write(comparison)
    judge(comparison, "")

  private def pairOf(image: Path, reference: Path): ImagePair =
    val (a, b) = (ImageFiles.read(image), ImageFiles.read(reference))
    val pair = asked.channels.fold(ImagePair(a, b))(ImagePair.of(a, b, _))
    asked.crop.fold(pair)(pair.cropped)

  private def write(comparison: Comparison): Unit =
    for name <- asked.difference do
      ImageFiles.write(Path.of(name), comparison.pair.difference)
    for name <- asked.heatMap do
      val metric = asked.heatMapMetric
      val map = ErrorMap(metric, comparison.pair)
      if name.toLowerCase.endsWith(".exr") then ImageFiles.write(Path.of(name), map)
      else
        val most = asked.heatMapMax.getOrElse(HeatMap.usualBrightest(metric, map))
        val about = Vector("metric" -> metric.word, "brightest" -> most.toString)
        ImageFiles.write(Path.of(name), HeatMap.of(map, most), about)
        terminal.out.println(
          s"heat map      ${metric.title} from 0 to ${Figures.scientific(most)}, in $name"
        )

  /** Every image of the folder, against the one of the same name, or all against one. */
  private def compareSet(images: Path, references: Path): ExitCode =
    if asked.writesPictures then
      throw ImageError("--difference and --heatmap are of two images, not of folders")
    val set = ReferenceSet.of(images, references)
    for file <- set.missing do terminal.err.println(s"$file has no reference in $references")
    val comparisons =
      set.pairs.map((image, reference) => image -> Comparison(pairOf(image, reference)))
    terminal.out.print(ReferenceSet.table(comparisons).map(_ + "\n").mkString)
    val codes = comparisons.map((image, c) => judge(c, s"${image.getFileName}: "))
    val unknown = if set.missing.isEmpty then ExitCode.Done else ExitCode.BadInput
    codes.foldLeft(unknown)(_ worseOf _)

  /** With limits, pixels that can't be compared are a failure too: NaN must not pass for equal. */
  private def judge(comparison: Comparison, name: String): ExitCode =
    val skipped = comparison.metrics.skipped
    val wrong =
      if asked.limits.isEmpty then Vector.empty
      else if skipped > 0 then Vector(s"${Figures.count(skipped, "pixel")} can't be compared")
      else asked.limits.flatMap(_.broken(comparison))
    wrong.foreach(text => terminal.err.println(name + text))
    if wrong.isEmpty then ExitCode.Done else ExitCode.BadInput

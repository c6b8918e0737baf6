package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError, Severity}
import candela.io.{FileName, SceneFolder}
import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import candela.cli.files.{FileRegister, ImageParts, InputImages, Output, OutputFiles}
import candela.cli.options.{Limit, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal}
import candela.image.{Contents, Image, ImageError, ImageFiles, OutputFormat, WriteOptions}
import candela.measure.{ErrorLayer, ErrorMap, Flip, HeatMap, ImagePair, Metrics, OwnError}

/** `candela compare`: measures the error of an image, or of each image of a folder, against a
  * reference.
  */
final class CompareCommand(options: Options, terminal: Terminal, report: Report):
  private val compareOptions = options.compare

  def run(): ExitCode = report.guarded:
    val Vector(image, reference) = options.files.map(OutputFiles.path): @unchecked
    val register = FileRegister()
    lazy val Vector(a, b) = options.files.map(ImageSet.named): @unchecked
    val files = if compareOptions.bias then a.files ++ b.files else Vector(image, reference)
    files.foreach(CompareCommand.check)
    if compareOptions.bias then a.checkApart(b)
    register.read(files)
    for (kind, name, option) <- pictures do
      val file = OutputFiles.ofImages(Vector(name))
      file.check()
      register.write(Output(file.paths, kind, options.files.head, option))
    val code =
      if compareOptions.bias then BiasComparison(compareOptions, terminal, a, b).run()
      else if Files.isDirectory(image) then compareSet(image, reference)
      else compareTwo(image, reference)
    terminal.out.flush()
    code

  private def pictures: Vector[(String, String, String)] =
    compareOptions.difference.map(("difference", _, "difference")).toVector ++
      compareOptions.heatMap.map(("heat map", _, "heatmap"))

  private def compareTwo(image: Path, reference: Path): ExitCode =
    val comparison = compared(image, reference)
    comparison.lines.foreach(terminal.out.println)
    if compareOptions.perChannel then comparison.perChannel.foreach(terminal.out.println)
    write(comparison)
    judge(comparison, "")

  private def pairOf(a: Image, b: Image): ImagePair =
    val pair = compareOptions.channels.fold(ImagePair(a, b))(ImagePair.of(a, b, _))
    compareOptions.crop.fold(pair)(pair.cropped)

  private def compared(image: Path, reference: Path): Comparison =
    val truth = InputImages.read(reference, report)
    val measured = InputImages.read(image, report)
    CompareCommand.checkParts(image -> measured, reference -> truth)
    CompareCommand.checkParts(reference -> truth, image -> measured)
    for message <- ImageParts.shared(Vector(image, reference)).left do
      val warning = Problem(Code.DifferentImages, Severity.Warning, None, message)
      report.warnings(Vector(warning), all = true)
    val comparison = Comparison(pairOf(measured, truth))
    // The error is that of R, G and B
    val errorSource = if comparison.pair.isColor then ErrorLayer.extract(truth) else truth
    comparison.copy(own =
      ErrorLayer.error(compareOptions.crop.fold(errorSource)(_.of(errorSource)))
    )

  private def write(comparison: Comparison): Unit =
    val difference = compareOptions.difference.map(OutputFiles.path)
    val heatMap = compareOptions.heatMap.map(OutputFiles.path)
    val window =
      if compareOptions.crop.isDefined then None
      else ImageParts.shared(options.files.map(OutputFiles.path)).toOption.flatten
    OutputFiles.writeAll((difference ++ heatMap).toVector): path =>
      if difference.contains(path) then
        ImageFiles.write(path, comparison.pair.difference, options = WriteOptions(window = window))
      else writeHeatMap(comparison.pair, path)

  private def writeHeatMap(pair: ImagePair, path: Path): Unit =
    val metric = compareOptions.heatMapMetric
    val map = ErrorMap(metric, pair)
    val isFalseColor = OutputFormat.of(path).exists(_.contents == Contents.Display)
    if !isFalseColor then ImageFiles.write(path, map)
    else
      val brightest = compareOptions.heatMapMax.getOrElse(HeatMap.usualBrightest(metric, map))
      val about = Vector("metric" -> metric.word, "brightest" -> brightest.toString)
      ImageFiles.write(path, HeatMap.of(map, brightest), about)
      terminal.out.println(
        s"heat map      ${metric.title} from 0 to ${Figures.scientific(brightest)}, in $path"
      )

  /** Compares each image of a folder with the reference of the same name, or all with one
    * reference.
    */
  private def compareSet(images: Path, references: Path): ExitCode =
    if compareOptions.writesPictures then
      throw ImageError(
        Code.DifferentImages,
        "--difference and --heatmap need two images, not folders"
      )
    val set = ReferenceSet.of(images, references)
    for file <- set.missing do terminal.err.println(s"$file: no reference in $references")
    val comparisons =
      set.pairs.map((image, reference) => image -> compared(image, reference))
    ReferenceSet.table(comparisons).foreach(terminal.out.println)
    val codes = comparisons.map((image, c) => judge(c, s"${image.getFileName}: "))
    val unknown = if set.missing.isEmpty then ExitCode.Done else ExitCode.BadInput
    codes.foldLeft(unknown)(_ worseOf _)

  /** If limits are set, NaN and infinite pixels fail the comparison too: NaN must not pass as
    * equal.
    */
  private def judge(comparison: Comparison, name: String): ExitCode =
    val skipped = comparison.metrics.skipped
    val wrong =
      if compareOptions.limits.isEmpty then Vector.empty
      else if skipped > 0 then Vector(s"NaN or infinite in ${Figures.count(skipped, "pixel")}")
      else compareOptions.limits.flatMap(BrokenLimits.of(_, comparison))
    wrong.foreach(text => terminal.err.println(name + text))
    if wrong.isEmpty then ExitCode.Done else ExitCode.BadInput

object CompareCommand:
  /** @throws SceneError if there is no such file */
  private def check(file: Path): Unit = if !Files.exists(file) then
    val message = s"$file: there is no such file"
    throw SceneError(Problem.general(Code.NoSuchFile, message, SceneFolder.suggestionFor(file)))

  /** @throws ImageError if an image is a crop of another one's size, as its file says */
  private def checkParts(crop: (Path, Image), whole: (Path, Image)): Unit =
    val (part, all) = (crop._2, whole._2)
    if part.width != all.width || part.height != all.height then
      for
        window <- ImageFiles.about(crop._1)._1
        if window.width == all.width && window.height == all.height
      do
        val (x, y) = (window.x, window.y)
        val pixels = s"$x,${x + part.width},$y,${y + part.height}"
        throw ImageError(
          Code.DifferentImages,
          s"${crop._1} has the pixels $pixels of an image as large as ${whole._1}; cut that one " +
            s"with `candela image ${whole._1} --crop $pixels`"
        )

/** An image with its reference, and their error metrics.
  *
  * @param flip mean FLIP error; None if there are no colour channels
  * @param own  the reference's own error, if it is stored with it
  */
final case class Comparison(
    pair: ImagePair,
    metrics: Metrics,
    flip: Option[Double],
    own: Option[OwnError] = None
):

  def lines: Vector[String] =
    val m = metrics
    val ratios = m.channels.zip(m.meanRatio).map((c, r) => s"$c ${Figures.fixed(r, 4)}")
    val difference = Figures.scientific(m.largest.value)
    val largest = m.largest
    Vector(
      s"error         ${Comparison.error(m.relativeMse)}",
      s"MSE           ${Figures.scientific(m.mse)}",
      s"RMSE          ${Figures.scientific(m.rmse)}",
      s"MAE           ${Figures.scientific(m.mae)}",
      s"relative MSE  ${Figures.scientific(m.relativeMse)}",
      s"PSNR          ${Comparison.decibels(m.psnr)}"
    ) ++ flip.map(f => s"FLIP          ${Figures.scientific(f)}") ++ Vector(
      s"mean ratio    ${ratios.mkString("  ")}",
      s"largest       $difference in ${largest.channel} at (${largest.x}, ${largest.y})"
    ) ++ own.toVector.flatMap(ofReference) ++ Option.when(m.skipped > 0):
      s"skipped       ${Figures.count(m.skipped, "pixel")}, NaN or infinite"

  /** The reference's own error, and those of the image without it. */
  private def ofReference(own: OwnError): Vector[String] =
    def excess(all: Double, part: Double) =
      if all > part then Figures.scientific(all - part)
      else s"not resolved (${Figures.scientific(all - part)})"
    Vector(
      s"reference     MSE ${Figures.scientific(own.mse)}, " +
        s"relative MSE ${Figures.scientific(own.relativeMse)}, included above",
      s"without it    MSE ${excess(metrics.mse, own.mse)}, " +
        s"relative MSE ${excess(metrics.relativeMse, own.relativeMse)}"
    )

  /** Table of per-channel metrics. */
  def perChannel: Vector[String] =
    val head = Vector("channel", "MSE", "RMSE", "MAE", "relative MSE", "mean", "reference", "ratio")
    val rows = metrics.perChannel.map: c =>
      val figures = Vector(c.mse, c.rmse, c.mae, c.relativeMse, c.mean, c.referenceMean)
      (c.name +: figures.map(Figures.scientific)) :+ Figures.fixed(c.meanRatio, 4)
    Comparison.aligned(head +: rows)

object Comparison:

  def apply(pair: ImagePair): Comparison =
    val metrics = Metrics.compare(pair.image, pair.reference)
    val flip = Option.when(pair.isColor)(Flip.mean(pair))
    Comparison(pair, metrics, flip)

  /** The relative error, as `--error` has it. */
  def error(relativeMse: Double): String = Figures.percentage(Math.sqrt(relativeMse))

  def decibels(psnr: Double): String =
    if psnr.isInfinite then "infinite" else s"${Figures.fixed(psnr, 2)} dB"

  /** Pads columns to their widest cell; numbers are right-aligned. */
  def aligned(rows: Vector[Vector[String]]): Vector[String] =
    val widths = rows.head.indices.map(i => rows.map(_(i).length).max)
    rows.map: row =>
      val cells = row.zip(widths).tail.map((cell, width) => " " * (width - cell.length) + cell)
      (row.head.padTo(widths.head, ' ') +: cells).mkString("  ")

/** Images paired with their references.
  *
  * @param missing images without a reference
  */
final case class ReferenceSet(pairs: Vector[(Path, Path)], missing: Vector[Path])

object ReferenceSet:
  /** Pairs images with references: one for all, or a folder searched by name without suffix.
    *
    * @throws ImageError if the folder contains no images
    */
  def of(images: Path, references: Path): ReferenceSet =
    val candidates = files(images)
    if candidates.isEmpty then
      throw ImageError(Code.DifferentImages, s"$images: no images in this folder")
    if Files.isDirectory(references) then
      val byStem = files(references).groupBy(FileName.stem)
      val matched = candidates.map: image =>
        // Of several candidates, prefers the image's own format, then the order of the suffixes,
        // EXR first.
        val matches = byStem.getOrElse(FileName.stem(image), Vector.empty)
        image -> matches.minByOption: r =>
          val suffix = FileName.suffix(r)
          (suffix != FileName.suffix(image), ImageFiles.readable.indexOf(suffix))
      ReferenceSet(
        matched.collect { case (image, Some(reference)) => (image, reference) },
        matched.collect { case (image, None) => image }
      )
    else
      val referencePath = references.toAbsolutePath.normalize
      val compared = candidates.filterNot(_.toAbsolutePath.normalize == referencePath)
      ReferenceSet(compared.map(image => (image, references)), Vector.empty)

  /** One row per comparison, and the means. */
  def table(comparisons: Vector[(Path, Comparison)]): Vector[String] =
    // Which MSE and relative MSE include
    val isOwnKnown = comparisons.exists(_._2.own.isDefined)
    val last = Option.when(isOwnKnown)("reference's relative MSE")
    val head =
      Vector("image", "error", "MSE", "MAE", "relative MSE", "PSNR", "FLIP", "bias") ++ last
    def row(name: String, c: Comparison) =
      val m = c.metrics
      Vector(name, Comparison.error(m.relativeMse)) ++
        Vector(m.mse, m.mae, m.relativeMse).map(Figures.scientific) ++
        Vector(Comparison.decibels(m.psnr), c.flip.fold("-")(Figures.scientific)) ++
        Vector(Figures.scientific(m.bias)) ++
        Option.when(isOwnKnown)(c.own.fold("-")(o => Figures.scientific(o.relativeMse)))
    def mean(figure: Comparison => Double) =
      Figures.scientific(comparisons.map((_, c) => figure(c)).sum / comparisons.size)
    val means = Option.when(comparisons.sizeIs > 1):
      val flip = if comparisons.forall(_._2.flip.isDefined) then mean(_.flip.get) else "-"
      val error = comparisons.map((_, c) => c.metrics.relativeMse).sum / comparisons.size
      Vector("mean", Comparison.error(error)) ++
        Vector(mean(_.metrics.mse), mean(_.metrics.mae), mean(_.metrics.relativeMse), "") ++
        Vector(flip, mean(_.metrics.bias)) ++ Option.when(isOwnKnown)("")
    Comparison.aligned(
      head +: (comparisons.map((path, c) => row(path.getFileName.toString, c)) ++ means)
    )

  private[commands] def files(folder: Path): Vector[Path] =
    Using.resource(Files.list(folder)): all =>
      all.iterator.asScala.toVector.filter(f =>
        ImageFiles.readable.contains(FileName.suffix(f)) && Files.isRegularFile(f)
      ).sorted

/** Bounds on metrics that a comparison exceeds. */
private object BrokenLimits:
  /** The violation, if any; a metric that can't be computed violates its bound. */
  def of(limit: Limit, c: Comparison): Option[String] = limit.option match
    case "min-psnr" =>
      Option.unless(c.metrics.psnr >= limit.value)(violation(limit, c.metrics.psnr, "below"))
    case other =>
      val measured = figures(other)(c)
      Option.unless(measured.exists(_ <= limit.value)):
        measured.fold(s"${limit.figure} can't be computed for these images")(violation(
          limit,
          _,
          "above"
        ))

  private def violation(limit: Limit, measured: Double, where: String): String =
    s"${limit.figure} ${Figures.scientific(measured)} is $where --${limit.option} ${limit.value}"

  private val figures: Map[String, Comparison => Option[Double]] = Map(
    "max-mse" -> (c => Some(c.metrics.mse)),
    "max-rmse" -> (c => Some(c.metrics.rmse)),
    "max-mae" -> (c => Some(c.metrics.mae)),
    "max-relmse" -> (c => Some(c.metrics.relativeMse)),
    "max-bias" -> (c => Some(c.metrics.bias)),
    "max-flip" -> (c => c.flip)
  )

package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.Code
import candela.cli.files.{FileRegister, OutputFiles}
import candela.cli.options.CompareOptions
import candela.cli.terminal.{ExitCode, Terminal}
import candela.image.{Contents, Image, ImageEdits, ImageError, ImageFiles, OutputFormat}
import candela.job.ReferenceFile
import candela.measure.{BiasRegion, BiasTest, ErrorLayer, HeatMap, ImagePair, Renderings, TileSums}

import java.nio.file.{FileSystems, Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** `candela compare --bias`: tests whether two programs render the same expected image. */
private[commands] final class BiasComparison(
    options: CompareOptions,
    terminal: Terminal,
    a: ImageSet,
    b: ImageSet
):
  def run(): ExitCode =
    val test = BiasTest.of(renderings(a), renderings(b))
    lines(test).foreach(terminal.out.println)
    for name <- options.heatMap do writeMap(test, OutputFiles.path(name))
    if test.skipped > 0 then
      terminal.err.println(s"NaN or infinite in ${Figures.count(test.skipped, "tile")}")
    if isFound(test) || test.skipped > 0 then ExitCode.BadInput else ExitCode.Done

  private def isFound(test: BiasTest): Boolean = test.p < options.significance

  private def renderings(set: ImageSet): Renderings = set.files match
    case Vector(file) => withVariance(file)
    case files =>
      try Renderings.seeds(files.map(file => TileSums.of(selected(ImageFiles.read(file)))))
      catch case e: ImageError => throw ImageError(e.code, s"${set.name}: ${e.getMessage}")

  /** The channels to compare, of the part to compare. */
  private def selected(image: Image): Image =
    val pair =
      options.channels.fold(ImagePair(image, image))(ImagePair.of(image, image, _))
    options.crop.fold(pair)(pair.cropped).image

  private def withVariance(file: Path): Renderings =
    val image = ImageFiles.read(file)
    val facts = ImageFiles.facts(file).toMap
    val names = options.channels.getOrElse(Image.RgbNames)
    PixelNoise.of(image, facts, names) match
      case Some(PixelNoise(variance, freedom, correlation)) =>
        val values = options.crop.fold(variance)(_.of(variance))
        Renderings.withVariance(selected(image), values, freedom, correlation)
      case None =>
        throw ImageError(
          Code.DifferentImages,
          s"$file: a single image needs its own error, which `candela reference` stores" +
            PixelNoise.lack(image) + "; or name images of several seeds: a folder, " +
            "A.exr,B.exr or 'NAME*.exr'"
        )

  private def lines(test: BiasTest): Vector[String] =
    val verdict = if isFound(test) then "found" else "none found"
    val regions =
      if isFound(test) then test.worst.filter(_.adjusted < options.significance)
      else test.worst.take(1)
    val title = if isFound(test) then "different" else "least alike"
    val percent = Figures.percentage(test.shareBelow(options.significance))
    val tenths = test.histogram.map(s => Figures.fixed(100 * s, 1)).mkString(" ")
    Vector(
      s"bias          $verdict: p = ${figure(test.p)}",
      s"compared      ${a.size} and ${b.size}",
      s"whole image   ${test.fullImage.map(r => s"${r.channel} ${ratio(r)}").mkString("  ")}",
      s"small tiles   $percent of ${test.tiles.length} have p < ${options.significance}, by " +
        s"chance ${Figures.percentage(options.significance)}",
      s"p by tenths   $tenths (% of them, by chance 10 each)"
    ) ++ regions.map: r =>
      s"${title.padTo(14, ' ')}${location(r)}: ${ratio(r)}, p = ${figure(r.adjusted)}"

  private def location(r: BiasRegion): String =
    val w = r.window
    s"${r.channel} in x ${w.x0} to ${w.x1}, y ${w.y0} to ${w.y1}"

  /** With its standard error. */
  private def ratio(r: BiasRegion): String =
    if r.b == 0 then s"${Figures.scientific(r.a)} ± ${Figures.scientific(r.error)}, and 0"
    else s"${Figures.fixed(r.a / r.b, 4)} ± ${Figures.fixed(Math.abs(r.error / r.b), 4)}"

  private def figure(p: Double): String =
    if p >= 0.001 then Figures.fixed(p, 3) else Figures.scientific(p)

  private def writeMap(test: BiasTest, path: Path): Unit =
    val isFalseColor = OutputFormat.of(path).exists(_.contents == Contents.Display)
    if !isFalseColor then ImageFiles.write(path, test.map)
    else
      val maxPower = options.heatMapMax.getOrElse(BiasTest.UsualPowers)
      val about = Vector("metric" -> "p-value", "brightest" -> maxPower.toString)
      ImageFiles.write(path, HeatMap.of(test.powers, maxPower), about)
      val minP = Figures.general(Math.pow(10, -maxPower))
      terminal.out.println(s"heat map      p-value from 1 to $minP, in $path")

/** Images of one program, by the name that the user gave them. */
private[commands] final case class ImageSet(name: String, files: Vector[Path]):
  def size: String = files match
    case Vector(file) => s"`${file.getFileName}` with its variance"
    case several => Figures.count(several.size, "image")

  /** Noise of the same seeds would cancel in the difference, and any two sets seem alike.
    *
    * @throws ImageError if both sets have an image
    */
  def checkApart(other: ImageSet): Unit =
    val register = FileRegister()
    register.read(other.files)
    val common = files.filter(register.hasRead)
    for first <- common.headOption do
      val otherCount = common.size - 1
      val subject =
        if otherCount == 0 then s"`$first` is"
        else s"`$first` and ${Figures.count(otherCount, "more image")} are"
      throw ImageError(
        Code.DifferentImages,
        s"$subject in both sets; each set needs its own seeds"
      )

private[commands] object ImageSet:
  /** A folder's images, or those of names and patterns between commas.
    *
    * @throws ImageError if there are none, or one is named twice
    */
  def named(name: String): ImageSet =
    val path = OutputFiles.path(name)
    if Files.isDirectory(path) then checked(name, ReferenceSet.files(path))
    else if Files.exists(path) then ImageSet(name, Vector(path))
    else
      checked(name, name.split(",").toVector.map(_.trim).filter(_.nonEmpty).flatMap(matching))

  private def checked(name: String, files: Vector[Path]): ImageSet =
    if files.isEmpty then
      throw ImageError(Code.NoSuchFile, s"$name: expected images, found none")
    for twice <- files.diff(files.distinct).headOption do
      throw ImageError(
        Code.DifferentImages,
        s"$name: `$twice` is given twice; use different seeds"
      )
    ImageSet(name, files)

  private def matching(name: String): Vector[Path] =
    val isPattern = name.exists(c => c == '*' || c == '?')
    // Windows allows no such names
    val slash = name.lastIndexWhere(c => c == '/' || c == '\\')
    if !isPattern then Vector(OutputFiles.path(name))
    else
      val folder = OutputFiles.path(name.take(slash + 1))
      val matcher = FileSystems.getDefault.getPathMatcher(s"glob:${name.drop(slash + 1)}")
      val directory = if folder.toString.isEmpty then Path.of(".") else folder
      if !Files.isDirectory(directory) then Vector.empty
      else
        Using.resource(Files.list(directory)): all =>
          all.iterator.asScala.toVector.filter(f => matcher.matches(f.getFileName))
            .map(f => folder.resolve(f.getFileName)).sorted

/** The variance of an image's values, as far as its file has it.
  *
  * @param freedom degrees of freedom of each variance
  * @param correlation of pixels that share samples, as in [[Renderings.Known]]
  */
private[commands] final case class PixelNoise(
    variance: Image,
    freedom: Double,
    correlation: Double
)

private[commands] object PixelNoise:
  /** Of the named channels.
    *
    * @param facts what the file says of itself
    */
  def of(
      image: Image,
      facts: Map[String, String],
      channels: Vector[String]
  ): Option[PixelNoise] =
    def layer(name: String): Option[Image] =
      val layerChannels = channels.map(c => s"$name.$c")
      Option.when(layerChannels.forall(image.channelNames.contains)):
        Image(image.width, image.height, channels, ImageEdits.select(image, layerChannels).data)
    def count(name: String) = facts.get(name).flatMap(_.toIntOption).filter(_ >= 2)
    for variance <- layer(ErrorLayer.Name); runs <- count(ReferenceFile.Runs) yield
      val correlation =
        facts.get(ReferenceFile.Correlation).flatMap(_.toDoubleOption).getOrElse(1.0)
      PixelNoise(variance, runs - 1, correlation)

  /** Why a layer that an image has is not its noise. */
  def lack(image: Image): String =
    val hasVariance = image.channelNames.exists(_.startsWith("Variance."))
    if hasVariance then " (its layer variance leaves out samples of the sky, as pbrt-v4's does)"
    else ""

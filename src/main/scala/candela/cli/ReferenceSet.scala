package candela.cli

import candela.image.ImageError

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Images and what they are to be compared with.
  *
  * @param missing images without a reference
  */
final case class ReferenceSet(pairs: Vector[(Path, Path)], missing: Vector[Path])

object ReferenceSet:
  private val Endings = Vector("exr", "hdr", "png", "tga", "jpg", "jpeg")

  /** References are a folder, with names that but for the ending are the same, or one image.
    *
    * @throws ImageError if there are no images
    */
  def of(images: Path, references: Path): ReferenceSet =
    val found = files(images)
    if found.isEmpty then throw ImageError(s"$images: there are no images in this folder")
    if Files.isDirectory(references) then
      val known = files(references).groupBy(stem)
      val matched = found.map: image =>
        // Of several the one of the same format; else EXR, as the order of endings has it.
        val same = known.getOrElse(stem(image), Vector.empty)
        image -> same.minByOption(r => (ending(r) != ending(image), Endings.indexOf(ending(r))))
      ReferenceSet(
        matched.collect { case (image, Some(reference)) => (image, reference) },
        matched.collect { case (image, None) => image }
      )
    else
      val one = references.toAbsolutePath.normalize
      val others = found.filterNot(_.toAbsolutePath.normalize == one)
      ReferenceSet(others.map(image => (image, references)), Vector.empty)

  /** A line for each comparison, and their means. */
  def table(comparisons: Vector[(Path, Comparison)]): Vector[String] =
    val head = Vector("image", "MSE", "MAE", "relative MSE", "PSNR", "FLIP", "bias")
    def row(name: String, c: Comparison) =
      val m = c.metrics
      Vector(m.mse, m.mae, m.relativeMse).map(Figures.scientific).prepended(name) ++
        Vector(Comparison.decibels(m.psnr), c.flip.fold("-")(Figures.scientific)) :+
        Figures.scientific(m.bias)
    def mean(figure: Comparison => Double) =
      Figures.scientific(comparisons.map((_, c) => figure(c)).sum / comparisons.size)
    val means = Option.when(comparisons.sizeIs > 1):
      val flip = if comparisons.forall(_._2.flip.isDefined) then mean(_.flip.get) else "-"
      Vector("mean", mean(_.metrics.mse), mean(_.metrics.mae), mean(_.metrics.relativeMse), "") ++
        Vector(flip, mean(_.metrics.bias))
    Comparison.aligned(
      head +: (comparisons.map((path, c) => row(path.getFileName.toString, c)) ++ means)
    )

  private def files(folder: Path): Vector[Path] =
    Using.resource(Files.list(folder)): all =>
      all.iterator.asScala.toVector.filter(f => Endings.contains(ending(f))).sorted

  private def stem(path: Path): String =
    val name = path.getFileName.toString
    name.take(name.lastIndexOf('.'))

  private def ending(path: Path): String =
    val name = path.getFileName.toString
    name.drop(name.lastIndexOf('.') + 1).toLowerCase

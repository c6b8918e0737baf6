package candela.cli.files

import candela.image.{ImageFiles, ImageWindow}

import java.nio.file.Path

/** Crops, which know where they lie in a larger image. */
private[cli] object ImageParts:

  /** The part that all of the files show, if all say so; or why they show different ones. */
  def shared(files: Seq[Path]): Either[String, Option[ImageWindow]] =
    val crops = for file <- files; window <- ImageFiles.about(file)._1 yield file -> window
    crops.find(_._2 != crops.head._2) match
      case Some(other) => Left(s"${text(crops.head)}, ${text(other)}: not the same part")
      case None => Right(crops.headOption.map(_._2).filter(_ => crops.size == files.size))

  private def text(crop: (Path, ImageWindow)) =
    val (file, w) = crop
    s"$file begins at pixel (${w.x}, ${w.y}) of an image of ${w.width}x${w.height}"

package candela.image

import candela.base.FileName

import java.nio.file.Path

/** Pixel data that a format can store. */
enum Contents:
  /** Display-referred colours: 8 bits, sRGB, clamped to [0, 1]. */
  case Display

  /** Linear red, green and blue as floats. */
  case Radiance

  /** Floats in arbitrarily named channels. */
  case Channels

/** An output file format; all are listed in [[OutputFormat.all]].
  *
  * @param suffix file extension, in lower case
  */
abstract class OutputFormat(val suffix: String, val contents: Contents):

  /** Encodes an image file.
    *
    * @param metadata names and texts to store, if the format supports them
    * @param isHalf   whether to store 16-bit instead of 32-bit floats, if the format supports both
    */
  private[image] def write(
      image: Image,
      metadata: Vector[(String, String)],
      isHalf: Boolean = false
  ): Array[Byte]

object OutputFormat:
  val all: Vector[OutputFormat] = Vector(Exr, Png)

  /** Replaces formats that are not supported. */
  val default: OutputFormat = Exr

  /** Preview format for images that can't be displayed directly. */
  val preview: OutputFormat = Png

  def of(path: Path): Option[OutputFormat] = all.find(_.suffix == FileName.suffix(path))

  /** Extensions of the formats with such contents, or of all: `.exr or .png`. */
  def listed(contents: Contents*): String =
    inWords(all.filter(f => contents.isEmpty || contents.contains(f.contents)))

  private[image] def inWords(formats: Seq[OutputFormat]): String =
    val names = formats.map(f => s".${f.suffix}")
    if names.size < 2 then names.mkString
    else s"${names.init.mkString(", ")} or ${names.last}"

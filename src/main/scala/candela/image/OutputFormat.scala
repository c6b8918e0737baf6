package candela.image

import candela.base.FileName

import java.nio.file.Path

/** What a file can store. */
enum Contents:
  /** Colours to be displayed: 8 bits, sRGB, clamped to [0, 1]. */
  case Display

  /** Linear red, green and blue as floats. */
  case Radiance

  /** Floats in channels of any names. */
  case Channels

/** A file format that images are written in: its object, and its place in [[OutputFormat.all]].
  *
  * @param suffix of file names, in lower case
  */
abstract class OutputFormat(val suffix: String, val contents: Contents):

  /** The bytes of a file.
    *
    * @param metadata names and texts that the file carries along, if the format has them
    * @param isHalf   floats of 16 bits, not 32, if the format has both
    */
  private[image] def write(
      image: Image,
      metadata: Vector[(String, String)],
      isHalf: Boolean = false
  ): Array[Byte]

object OutputFormat:
  val all: Vector[OutputFormat] = Vector(Exr, Png)

  /** Written instead of formats that can't be. */
  val default: OutputFormat = Exr

  /** Written beside what can't be displayed as it is. */
  val preview: OutputFormat = Png

  def of(path: Path): Option[OutputFormat] = all.find(_.suffix == FileName.suffix(path))

  /** The suffixes of those with such contents, or of all: `.exr or .png`. */
  def listed(contents: Contents*): String =
    inWords(all.filter(f => contents.isEmpty || contents.contains(f.contents)))

  private[image] def inWords(formats: Seq[OutputFormat]): String =
    val names = formats.map(f => s".${f.suffix}")
    if names.size < 2 then names.mkString
    else s"${names.init.mkString(", ")} or ${names.last}"

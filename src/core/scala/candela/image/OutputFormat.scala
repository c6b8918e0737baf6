package candela.image

import candela.concurrency.Parallel
import candela.io.FileName
import java.nio.ByteBuffer
import java.nio.file.Path

/** Pixel data that a format can store. */
enum Contents:
  /** Display-referred colours: sRGB, clamped to [0, 1]. */
  case Display

  /** Linear red, green and blue as floats. */
  case Radiance

  /** Floats in arbitrarily named channels. */
  case Channels

/** Choices that some formats have.
  *
  * @param isHalf  whether to store 16-bit instead of 32-bit floats
  * @param others  the same of channels by name, where it differs
  * @param display how display formats show linear light
  * @param window  where the image lies in a larger one, of which it is a crop
  * @param alpha   opacity of each pixel, for display formats that keep it; the colours must have
  *                been divided by it
  * @param pool    encodes parts of the image, if the format has such
  */
final case class WriteOptions(
    isHalf: Boolean = false,
    others: Map[String, Boolean] = Map.empty,
    display: DisplayTransform = DisplayTransform.Plain,
    window: Option[ImageWindow] = None,
    alpha: Option[Array[Float]] = None,
    pool: Parallel = Parallel.Alone
)

/** An output file format; all are listed in [[OutputFormat.all]].
  *
  * @param suffix file extension, in lower case
  */
abstract class OutputFormat(val suffix: String, val contents: Contents):

  /** Other extensions of such files. */
  def aliases: Vector[String] = Vector.empty

  /** Whether its files hold metadata, as plain text. */
  def keepsTexts: Boolean = false

  /** Whether [[ImageFiles]] reads them, too. */
  def isReadable: Boolean = true

  /** Whether its files show transparency; formats of channels store any. */
  def keepsAlpha: Boolean = false

  /** Whether a file that can be decoded has its last byte, too, and no more: decoders are lenient.
    */
  private[image] def hasEnd(file: Array[Byte]): Boolean = true

  /** Encodes an image file.
    *
    * @param metadata names and texts to store, if the format supports them
    */
  private[image] def write(
      image: Image,
      metadata: Vector[(String, String)],
      options: WriteOptions = WriteOptions()
  ): Array[Byte]

  /** The same as the parts of the file, in order, if that saves a copy of a large one. */
  private[image] def buffers(
      image: Image,
      metadata: Vector[(String, String)],
      options: WriteOptions
  ): Vector[ByteBuffer] = Vector(ByteBuffer.wrap(write(image, metadata, options)))

object OutputFormat:
  val all: Vector[OutputFormat] = Vector(Exr, Pfm, Png, Jpeg, Qoi, Tga, Npz)

  /** Replaces formats that are not supported. */
  val default: OutputFormat = Exr

  /** Preview format for images that can't be displayed directly. */
  val preview: OutputFormat = Png

  def of(path: Path): Option[OutputFormat] =
    val suffix = FileName.suffix(path)
    all.find(f => f.suffix == suffix || f.aliases.contains(suffix))

  /** Extensions of the formats with such contents, or of all: `.exr, .png or .jpg`. */
  def listed(contents: Contents*): String =
    inWords(all.filter(f => contents.isEmpty || contents.contains(f.contents)))

  def inWords(formats: Seq[OutputFormat]): String =
    val names = formats.map(f => s".${f.suffix}")
    if names.size < 2 then names.mkString
    else s"${names.init.mkString(", ")} or ${names.last}"

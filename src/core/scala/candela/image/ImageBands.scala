package candela.image

import candela.io.InputFile
import candela.color.{ColorSpace, Encoding}

/** An image in bands of rows, from the top, which are read as often as they are visited: the image
  * itself need not fit into memory.
  *
  * @param isBytes whether bands are [[ByteImage]]s
  */
abstract class ImageBands(
    val width: Int,
    val height: Int,
    val channelNames: Vector[String],
    val encoding: Encoding,
    val colorSpace: ColorSpace,
    val isBytes: Boolean
):
  /** Visits each band with its first row, a multiple of [[ImageBands.Rows]], until one is not to be
    * followed. A band is valid while it is visited.
    *
    * @throws ImageError if the file can't be read as far
    */
  def visit(band: (Int, StoredImage) => Boolean): Unit

  /** Whether this holds for every band. */
  final def every(holds: StoredImage => Boolean): Boolean =
    var result = true
    visit: (_, band) =>
      result = holds(band)
      result
    result

  /** As [[Image.toReflectances]]. */
  final def toReflectances: ImageBands =
    val source = this
    new ImageBands(
      width,
      height,
      Image.RgbNames,
      Encoding.Linear,
      ColorSpace.Srgb,
      isBytes = false
    ):
      def visit(band: (Int, StoredImage) => Boolean): Unit =
        source.visit((y, image) => band(y, image.toImage.toReflectances))

object ImageBands:
  /** Rows of a band are a multiple of this, except the last band's. */
  val Rows = 64

  /** An image in memory. */
  def of(image: StoredImage): ImageBands =
    val isBytes = image match
      case _: ByteImage => true
      case _: Image => false
    new ImageBands(
      image.width,
      image.height,
      image.channelNames,
      image.encoding,
      image.colorSpace,
      isBytes
    ):
      def visit(band: (Int, StoredImage) => Boolean): Unit = band(0, image): Unit

  /** The image of a file whose format can be read in bands; None of others, and where the file
    * begins unusually.
    */
  def ofFile(file: InputFile): Option[ImageBands] = PngBands.of(file)

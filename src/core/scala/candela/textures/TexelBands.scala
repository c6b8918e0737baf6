package candela.textures

import candela.base.loop
import candela.image.{Image, ImageBands, StoredImage}

/** Texels of an image in bands of rows, from the top, which are made whenever they are visited.
  *
  * @param meaning of bytes, of which the texels of a band are then; else empty
  */
abstract class TexelBands(
    val width: Int,
    val height: Int,
    val channels: Int,
    val meaning: Array[Float]
):
  final def isBytes: Boolean = meaning.nonEmpty

  /** Visits bands with their first rows, which are multiples of [[ImageBands.Rows]].
    *
    * @param from bands that end before this row are passed over
    */
  def visit(from: Int)(band: (Int, Texels) => Unit): Unit

  /** All of them, in memory.
    *
    * @throws candela.image.ImageError if there are too many
    */
  final def inMemory: Texels =
    var single: Option[Texels] = None
    val count = Image.valueCount(width, height, channels)
    lazy val values = new Array[Float](count)
    lazy val codes = new Array[Byte](count)
    visit(0): (y, band) =>
      val start = y * width * channels
      if band.height == height then single = Some(band)
      else if isBytes then
        loop(width * band.height * channels)(i => codes(start + i) = band.code(i).toByte)
      else
        loop(width * band.height * channels): i =>
          values(start + i) = java.lang.Float.intBitsToFloat(band.code(i))
    single.getOrElse:
      if isBytes then ByteTexels(width, height, channels, codes, meaning)
      else FloatTexels(width, height, channels, values)

object TexelBands:

  /** Those of an image, of which `convert` makes them. */
  def apply(image: ImageBands, channels: Int, meaning: Array[Float])(
      convert: StoredImage => Texels
  ): TexelBands =
    new TexelBands(image.width, image.height, channels, meaning):
      def visit(from: Int)(band: (Int, Texels) => Unit): Unit =
        image.visit: (y, pixels) =>
          if y + pixels.height > from then band(y, convert(pixels))
          true

  /** In memory. */
  def of(texels: Texels): TexelBands =
    new TexelBands(texels.width, texels.height, texels.channels, texels.meaning):
      def visit(from: Int)(band: (Int, Texels) => Unit): Unit = band(0, texels)

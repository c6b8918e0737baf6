package candela.image

import candela.base.loop

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.{ByteBuffer, ByteOrder}

/** Place of an image within a larger one, of which it is a crop.
  *
  * @param x, y          its first pixel
  * @param width, height size of the larger image
  */
final case class ImageWindow(x: Int, y: Int, width: Int, height: Int)

/** Data and display windows of EXR files, which the encoder can't set. */
private[image] object ExrWindow:
  private val HeaderStart = 8

  /** Moves the pixels of a file of scanlines to their place in the window; changes `file`.
    *
    * @param rows scanlines per chunk
    */
  def place(file: Array[Byte], window: ImageWindow, height: Int, rows: Int): Unit =
    val bytes = ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN)
    def move(at: Int, by: Int): Unit =
      val _ = bytes.putInt(at, bytes.getInt(at) + by)
    val table = attributes(bytes): (name, at) =>
      if name == "dataWindow" then
        loop(4)(i => move(at + 4 * i, if i % 2 == 0 then window.x else window.y))
      else if name == "displayWindow" then
        val _ = bytes.putInt(at, 0).putInt(at + 4, 0)
        val _ = bytes.putInt(at + 8, window.width - 1).putInt(at + 12, window.height - 1)
    // Each chunk begins with the row of its first scanline.
    loop((height + rows - 1) / rows)(i => move(bytes.getLong(table + 8 * i).toInt, window.y))

  /** Where the last of the chunks of scanlines ends. */
  def end(file: Array[Byte], chunks: Int): Long =
    val bytes = ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN)
    val table = attributes(bytes)((_, _) => ())
    // Each begins with its first row and its size
    val ends =
      for
        i <- 0 until chunks
        chunk = bytes.getLong(table + 8 * i)
        if chunk >= 0 && chunk + 8 <= file.length
      yield chunk + 8 + bytes.getInt(chunk.toInt + 4)
    ends.maxOption.getOrElse(0L)

  /** Visits the attributes' names and places; returns where the table of chunks begins. */
  private def attributes(bytes: ByteBuffer)(visit: (String, Int) => Unit): Int =
    var at = HeaderStart
    def text(): String =
      val start = at
      while bytes.get(at) != 0 do at += 1
      at += 1
      String(bytes.array, start, at - 1 - start, ISO_8859_1)
    var name = text()
    while name.nonEmpty do
      val _ = text()
      val size = bytes.getInt(at)
      visit(name, at + 4)
      at += 4 + size
      name = text()
    at

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

  /** One file of those of its strips, which have `rowsPerStrip` scanlines, with the header of the
    * first. Changes the strips, and refers to them: there is no second copy of an image that may be
    * large.
    *
    * @param rows   scanlines per chunk
    * @param window moves the pixels to their place there
    */
  def joined(
      strips: Array[Array[Byte]],
      rowsPerStrip: Int,
      height: Int,
      rows: Int,
      window: Option[ImageWindow]
  ): Vector[ByteBuffer] =
    val sources = strips.map(ByteBuffer.wrap(_).order(ByteOrder.LITTLE_ENDIAN))
    val header = attributes(sources(0))((_, _) => ())
    val chunks = (height + rows - 1) / rows
    val head = ByteBuffer.allocate(header + 8 * chunks).order(ByteOrder.LITTLE_ENDIAN)
    head.put(0, strips(0), 0, header)
    setWindows(head, window, height)
    var offset = head.capacity.toLong
    val pixels = sources.zipWithIndex.map: (source, strip) =>
      val inStrip = (Math.min(rowsPerStrip, height - strip * rowsPerStrip) + rows - 1) / rows
      val table = attributes(source)((_, _) => ())
      val firstChunk = table + 8 * inStrip
      loop(inStrip): i =>
        val chunkOffset = source.getLong(table + 8 * i)
        // Each chunk begins with the row of its first scanline
        val row = source.getInt(chunkOffset.toInt) + strip * rowsPerStrip + window.fold(0)(_.y)
        source.putInt(chunkOffset.toInt, row)
        head.putLong(
          header + 8 * (strip * rowsPerStrip / rows + i),
          offset + chunkOffset - firstChunk
        ): Unit
      offset += source.capacity - firstChunk
      source.slice(firstChunk, source.capacity - firstChunk)
    head +: pixels.toVector

  /** Sets both windows of a header of some of the image's scanlines. */
  private def setWindows(head: ByteBuffer, window: Option[ImageWindow], height: Int): Unit =
    def putBox(at: Int, x0: Int, y0: Int, x1: Int, y1: Int): Unit =
      val _ = head.putInt(at, x0).putInt(at + 4, y0).putInt(at + 8, x1).putInt(at + 12, y1)
    val _ = attributes(head): (name, at) =>
      def right = head.getInt(at + 8)
      if name == "dataWindow" then
        window match
          case Some(w) => putBox(at, w.x, w.y, right + w.x, height - 1 + w.y)
          case None => putBox(at, 0, 0, right, height - 1)
      else if name == "displayWindow" then
        val (width, rows) = window.fold((right + 1, height))(w => (w.width, w.height))
        putBox(at, 0, 0, width - 1, rows - 1)

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

  /** Where the values of attributes are, by their names. */
  def valueOffsets(header: Array[Byte]): Map[String, Int] =
    val offsets = scala.collection.mutable.Map.empty[String, Int]
    val bytes = ByteBuffer.wrap(header).order(ByteOrder.LITTLE_ENDIAN)
    val _ = attributes(bytes)((name, at) => offsets(name) = at)
    offsets.toMap

  /** Visits the attributes' names and places; returns where the table of chunks begins. */
  private def attributes(bytes: ByteBuffer)(visit: (String, Int) => Unit): Int =
    var cursor = HeaderStart
    def text(): String =
      val start = cursor
      while bytes.get(cursor) != 0 do cursor += 1
      cursor += 1
      String(bytes.array, start, cursor - 1 - start, ISO_8859_1)
    var name = text()
    while name.nonEmpty do
      val _ = text()
      val size = bytes.getInt(cursor)
      visit(name, cursor + 4)
      cursor += 4 + size
      name = text()
    cursor

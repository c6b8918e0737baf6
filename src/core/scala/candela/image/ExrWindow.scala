package candela.image

import candela.base.{Code, loop}

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

  /** One file of those of its strips, which have `each` scanlines; all are alike but for these.
    *
    * @param rows scanlines per chunk
    */
  def joined(strips: Array[Array[Byte]], each: Int, height: Int, rows: Int): Array[Byte] =
    val sources = strips.map(ByteBuffer.wrap(_).order(ByteOrder.LITTLE_ENDIAN))
    val header = attributes(sources(0))((_, _) => ())
    val chunks = (height + rows - 1) / rows
    def table(strip: Int) = 8L * ((Math.min(each, height - strip * each) + rows - 1) / rows)
    val size = header + 8L * chunks +
      strips.indices.map(i => strips(i).length - header - table(i)).sum
    if size > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, "an EXR file of more than 2 GB")
    val bytes = ByteBuffer.allocate(size.toInt).order(ByteOrder.LITTLE_ENDIAN)
    bytes.put(strips(0), 0, header)
    val _ = attributes(bytes): (name, at) =>
      if name == "dataWindow" || name == "displayWindow" then
        val _ = bytes.putInt(at + 12, height - 1)
    var at = header + 8 * chunks
    loop(chunks): i =>
      val (strip, inStrip) = (i * rows / each, i * rows % each / rows)
      val source = sources(strip)
      val from = source.getLong(header + 8 * inStrip).toInt
      val length = 8 + source.getInt(from + 4)
      bytes.putLong(header + 8 * i, at)
      bytes.put(at, strips(strip), from, length)
      bytes.putInt(at, source.getInt(from) + strip * each)
      at += length
    bytes.array

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
  def places(header: Array[Byte]): Map[String, Int] =
    val found = scala.collection.mutable.Map.empty[String, Int]
    val bytes = ByteBuffer.wrap(header).order(ByteOrder.LITTLE_ENDIAN)
    val _ = attributes(bytes)((name, at) => found(name) = at)
    found.toMap

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

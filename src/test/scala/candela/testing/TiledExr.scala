package candela.testing

import java.io.ByteArrayOutputStream
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.Deflater

/** Tiled EXR files with levels, which the program itself doesn't write.
  *
  * Source: "OpenEXR File Layout", openexr.com.
  *
  * @param names  of channels, sorted
  * @param coding 0: not compressed, 3: ZIP; of others, tiles which that would not make smaller
  * @param mode   0: one level, 1: MIP map, 2: RIP map
  * @param texel  by level, x, y and channel; of RIP maps by x and y alone
  */
final class TiledExr(
    width: Int,
    height: Int,
    tileWidth: Int,
    tileHeight: Int,
    names: Vector[String] = Vector("B", "G", "R"),
    isHalf: Boolean = false,
    coding: Int = 3,
    mode: Int = 1,
    primaries: Option[Vector[Float]] = None
)(texel: (Int, Int, Int, Int) => Float):

  /** Rounded down. */
  val sizes: Vector[(Int, Int)] =
    val count = if mode == 0 then 1 else 32 - Integer.numberOfLeadingZeros(Math.max(width, height))
    Vector.iterate((width, height), count)((w, h) => (Math.max(1, w / 2), Math.max(1, h / 2)))

  private val values = sizes.zipWithIndex.map: (size, k) =>
    Array.tabulate(size._2, size._1, names.size)((y, x, c) => texel(k, x, y, c))

  /** A number that was written. */
  def apply(level: Int, x: Int, y: Int, c: Int): Float = values(level)(y)(x)(c)

  def write(file: Path): Path = Files.write(file, bytes)

  /** Where the table of chunks begins. */
  def table: Int = header.length

  def firstChunk: Int = header.length + 8 * chunks.size

  private lazy val header: Array[Byte] =
    val out = ByteArrayOutputStream()
    def text(s: String) = out.write(s.getBytes("US-ASCII") :+ 0.toByte)
    def ints(all: Int*) = all.foreach(i => out.write(little(4).putInt(i).array))
    def floats(all: Float*) = ints(all.map(java.lang.Float.floatToRawIntBits)*)
    def attribute(name: String, kind: String, size: Int) =
      text(name)
      text(kind)
      ints(size)
    ints(20000630, 0x202)
    attribute("channels", "chlist", names.map(_.length + 17).sum + 1)
    for name <- names do
      text(name)
      ints(if isHalf then 1 else 2, 0, 1, 1)
    out.write(0)
    attribute("compression", "compression", 1)
    out.write(coding)
    for window <- Vector("dataWindow", "displayWindow") do
      attribute(window, "box2i", 16)
      ints(0, 0, width - 1, height - 1)
    attribute("lineOrder", "lineOrder", 1)
    out.write(0)
    attribute("pixelAspectRatio", "float", 4)
    floats(1f)
    attribute("screenWindowCenter", "v2f", 8)
    floats(0f, 0f)
    attribute("screenWindowWidth", "float", 4)
    floats(1f)
    for p <- primaries do
      attribute("chromaticities", "chromaticities", 32)
      floats(p*)
    attribute("tiles", "tiledesc", 9)
    ints(tileWidth, tileHeight)
    out.write(mode)
    out.write(0)
    out.toByteArray

  private def little(size: Int) = ByteBuffer.allocate(size).order(ByteOrder.LITTLE_ENDIAN)

  private lazy val chunks: Vector[Array[Byte]] =
    // Of RIP maps only as many chunks as there must be
    val levels =
      if mode < 2 then sizes.zipWithIndex.map((size, k) => (size, k, k))
      else
        for ky <- sizes.indices.toVector; kx <- sizes.indices
        yield ((sizes(kx)._1, sizes(ky)._2), kx, ky)
    for
      ((w, h), kx, ky) <- levels
      y <- (0 until h by tileHeight).toVector
      x <- 0 until w by tileWidth
    yield
      val (right, bottom) = (Math.min(w, x + tileWidth), Math.min(h, y + tileHeight))
      val raw = little((right - x) * (bottom - y) * names.size * (if isHalf then 2 else 4))
      for row <- y until bottom; c <- names.indices; column <- x until right do
        val value = if mode == 2 then 0f else values(kx)(row)(column)(c)
        if isHalf then raw.putShort(half(value)) else raw.putFloat(value)
      val data = packed(raw.array)
      little(20 + data.length).putInt(x / tileWidth).putInt(y / tileHeight).putInt(kx).putInt(ky)
        .putInt(data.length).put(data).array

  /** Of 0, or a positive number that a half has with all of its bits. */
  private def half(value: Float): Short =
    val bits = java.lang.Float.floatToRawIntBits(value)
    if bits == 0 then 0 else ((bits >>> 13) - (112 << 10)).toShort

  /** Even bytes before odd ones, differences, deflated; as it is if that is no smaller. */
  private def packed(raw: Array[Byte]): Array[Byte] =
    if coding != 3 then raw
    else
      val sorted = raw.indices.by(2).map(raw(_)) ++ raw.indices.drop(1).by(2).map(raw(_))
      val differences = sorted.indices.map: i =>
        if i == 0 then sorted(0) else (sorted(i) - sorted(i - 1) + 128).toByte
      val deflater = Deflater()
      deflater.setInput(differences.toArray)
      deflater.finish()
      val out = new Array[Byte](raw.length + 100)
      val length = deflater.deflate(out)
      if length < raw.length then out.take(length) else raw

  private def bytes: Array[Byte] =
    val starts = chunks.scanLeft(firstChunk.toLong)(_ + _.length)
    val table = little(8 * chunks.size)
    for start <- starts.init do table.putLong(start): Unit
    header ++ table.array ++ chunks.flatten

package candela.textures

import candela.base.loop
import candela.io.CacheFolder
import java.io.{ByteArrayInputStream, ByteArrayOutputStream, DataInputStream, DataOutputStream}
import java.io.IOException
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.charset.StandardCharsets.US_ASCII
import java.util.zip.{CRC32, CRC32C}

import candela.color.{Encoding, Rgb}

/** What is known of an image in tiles.
  *
  * @param key      what it was made from, and how
  * @param encoding of the image file
  * @param facts    of its texels
  * @param channels of each texel
  * @param sizes    width and height of each level, and whether it has bytes
  * @param meaning  of bytes
  */
private[textures] final case class TileHeader(
    key: String,
    encoding: Encoding,
    facts: TexelFacts,
    channels: Int,
    sizes: Vector[(Int, Int, Boolean)],
    meaning: Vector[Float]
):
  val layouts: Vector[TileLayout] = TileLayout.ofLevels(sizes, channels)
  def count: Int = TileLayout.count(layouts)

/** Texels in memory that are put into tiles. */
private[textures] final class TilePacker(layouts: Vector[TileLayout], levels: Array[Texels]):

  def pack(tile: Int, into: Array[Int]): Unit =
    java.util.Arrays.fill(into, 0)
    loop(layouts.size): i =>
      val layout = layouts(i)
      val local = tile - layout.start
      if local >= 0 && local < layout.count then TilePacker.pack(layout, levels(i), 0, local, into)

private[textures] object TilePacker:

  /** Puts texels into one of the tiles of a level.
    *
    * @param texels rows of the level, all that are in the tile
    * @param first  the first of them
    * @param tile   of the level
    */
  def pack(layout: TileLayout, texels: Texels, first: Int, tile: Int, into: Array[Int]): Unit =
    val channels = texels.channels
    val x = tile % layout.tiles << layout.across
    val y = tile / layout.tiles << layout.down
    val length = channels * Math.min(1 << layout.across, layout.width - x)
    loop(Math.min(1 << layout.down, layout.height - y)): row =>
      val sourceOffset = ((y - first + row) * layout.width + x) * channels
      val targetOffset = layout.base + (row << layout.across) * channels
      if layout.isBytes then
        loop(length): i =>
          val k = targetOffset + i
          into(k >> 2) |= texels.code(sourceOffset + i) << ((k & 3) << 3)
      else loop(length)(i => into(targetOffset + i) = texels.code(sourceOffset + i))

/** A tile in a file: its numbers, little-endian, and their checksum. */
private[textures] object TileRecord:
  val Data: Int = 4 * TileMemory.Ints
  val Bytes: Int = Data + 4

  def seal(record: ByteBuffer): Int =
    val sum = CRC32C()
    sum.update(record)
    sum.getValue.toInt

/** A file of tiles: a mark, a header with its length and checksum, and tiles of one size. */
private[textures] final class TileFile private (
    val header: TileHeader,
    channel: FileChannel,
    start: Long
):
  /** Reads a tile.
    *
    * @return whether it is undamaged
    */
  def read(tile: Int, buffer: TileBuffer): Boolean =
    val bytes = buffer.bytes.clear()
    val offset = start + tile.toLong * TileRecord.Bytes
    val isThere =
      try
        while bytes.hasRemaining && channel.read(bytes, offset + bytes.position()) >= 0 do ()
        !bytes.hasRemaining
      catch case _: IOException => false
    isThere && {
      val sum = TileRecord.seal(bytes.clear().limit(TileRecord.Data))
      bytes.clear()
      val isWhole = bytes.getInt(TileRecord.Data) == sum
      if isWhole then bytes.asIntBuffer.get(buffer.ints): Unit
      isWhole
    }

private[textures] object TileFile:
  private val Mark = s"CTL3${CacheFolder.Mark}".getBytes(US_ASCII)

  /** Bytes of the mark, and of the header's length and checksum. */
  private val Start = Mark.length + 8
  private val MaxHeaderBytes = 1 << 20

  /** The tiles of a file of this key; None if it is missing, damaged or another.
    *
    * @param file opens it
    */
  def open(file: => FileChannel, key: String): Option[TileFile] =
    try
      val channel = file
      val tiles =
        try opened(channel, key)
        catch case _: IOException | _: IllegalArgumentException => None
      if tiles.isEmpty then channel.close()
      tiles
    catch case _: IOException => None

  private def opened(channel: FileChannel, key: String): Option[TileFile] =
    val beginning = read(channel, 0, Start)
    val mark = new Array[Byte](Mark.length)
    beginning.get(mark)
    val (length, sum) = (beginning.getInt, beginning.getInt)
    if !mark.sameElements(Mark) || length < 0 || length > MaxHeaderBytes then None
    else
      val bytes = read(channel, Start, length).array
      val header = Option.when(sum == checksum(bytes))(decoded(bytes)).filter(_.key == key)
      val start = Start.toLong + length
      header.filter(h => channel.size == start + h.count.toLong * TileRecord.Bytes)
        .map(TileFile(_, channel, start))

  private def read(channel: FileChannel, at: Long, length: Int): ByteBuffer =
    val bytes = ByteBuffer.allocate(length)
    while bytes.hasRemaining && channel.read(bytes, at + bytes.position()) >= 0 do ()
    if bytes.hasRemaining then throw IOException("the file ends early")
    bytes.flip()

  private def checksum(bytes: Array[Byte]): Int =
    val sum = CRC32()
    sum.update(bytes)
    sum.getValue.toInt

  /** @throws candela.image.ImageError if the image can't be read */
  def write(channel: FileChannel, key: String, texels: MadeTexels, wrap: Wrap): Unit =
    val bands = texels.bands
    val header = TileHeader(
      key,
      texels.encoding,
      TexelFacts(Vector.empty, None),
      bands.channels,
      texels.sizes,
      bands.meaning.toVector
    )
    // The facts are known at the end: there is room for as many colours as there may be
    val room = encoded(header).length + texels.colors.fold(0)(_.maxColors * 12)
    val facts = TileWriter.write(channel, Start.toLong + room, header.layouts, texels, wrap)
    texels.confirm()
    val headerBytes = encoded(header.copy(facts = facts)).padTo(room, 0.toByte)
    val buffer = ByteBuffer.allocate(Start + room)
    buffer.put(Mark).putInt(room).putInt(checksum(headerBytes)).put(headerBytes).flip()
    while buffer.hasRemaining do channel.write(buffer, buffer.position()): Unit

  private def encoded(h: TileHeader): Array[Byte] =
    val bytes = ByteArrayOutputStream()
    val output = DataOutputStream(bytes)
    output.writeUTF(h.key)
    output.writeFloat(h.encoding match
      case Encoding.Linear => 0f
      case Encoding.Srgb => -1f
      case Encoding.Gamma(exponent) => exponent)
    output.writeInt(h.channels)
    output.writeInt(h.sizes.size)
    for (width, height, isBytes) <- h.sizes do
      output.writeInt(width)
      output.writeInt(height)
      output.writeBoolean(isBytes)
    val odd = h.facts.odd.getOrElse(OddTexel(-1, -1, 0f))
    output.writeInt(odd.x)
    output.writeInt(odd.y)
    output.writeFloat(odd.value)
    output.writeInt(h.facts.colors.size)
    for c <- h.facts.colors; x <- Vector(c.r, c.g, c.b) do output.writeFloat(x)
    output.writeInt(h.meaning.size)
    h.meaning.foreach(output.writeFloat)
    bytes.toByteArray

  private def decoded(bytes: Array[Byte]): TileHeader =
    val input = DataInputStream(ByteArrayInputStream(bytes))
    def vector[A](element: => A): Vector[A] = Vector.fill(input.readInt())(element)
    val key = input.readUTF()
    val encoding = input.readFloat() match
      case 0f => Encoding.Linear
      case -1f => Encoding.Srgb
      case exponent => Encoding.Gamma(exponent)
    val channels = input.readInt()
    val sizes = vector((input.readInt(), input.readInt(), input.readBoolean()))
    val odd = Some(OddTexel(input.readInt(), input.readInt(), input.readFloat())).filter(_.x >= 0)
    val colors = vector(Rgb(input.readFloat(), input.readFloat(), input.readFloat()))
    val facts = TexelFacts(colors, odd)
    TileHeader(key, encoding, facts, channels, sizes, vector(input.readFloat()))

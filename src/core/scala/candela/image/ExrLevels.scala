package candela.image

import candela.diagnostics.Code
import candela.io.{InputFile, IoReason}
import java.io.IOException
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.channels.FileChannel

import candela.color.ColorSpace

/** A tiled EXR file with a MIP map, whose edges are powers of two, read tile by tile. Safe for
  * threads.
  */
final class ExrLevels private (
    file: InputFile,
    channel: FileChannel,
    part: ExrPart,
    tiling: ExrTiling,
    parts: ExrTileFile,
    offsets: Array[Long]
):
  def width: Int = part.width
  def height: Int = part.height
  def colorSpace: ColorSpace = part.colorSpace

  /** As of the image. */
  val channelNames: Vector[String] = Exr.order(part.channels.map(_.name)).map(part.channels(_).name)

  val tileWidth: Int = tiling.width
  val tileHeight: Int = tiling.height

  /** Width and height of each level, the largest first. */
  val sizes: Vector[(Int, Int)] = tiling.sizes(part.width, part.height)

  private val firstTiles =
    sizes.scanLeft(0)((sum, size) => sum + tiling.inLevel(size._1, size._2).toInt)

  /** A tile of a level.
    *
    * @param x, y number of the tile, across and down
    * @throws ImageError if it is damaged
    */
  def tile(level: Int, x: Int, y: Int): Image =
    val (w, h) = sizes(level)
    val across = (w + tileWidth - 1) / tileWidth
    val offset = offsets(firstTiles(level) + y * across + x)
    val width = Math.min(tileWidth, w - x * tileWidth)
    val height = Math.min(tileHeight, h - y * tileHeight)
    try
      val start = read(offset, ExrLevels.ChunkStart)
      val coordinates = Vector.fill(4)(start.getInt())
      val length = start.getInt()
      if coordinates != Vector(x, y, level, level) || length < 1 || length > part.bytes(
          width,
          height
        )
      then throw damaged(level, x, y, "it is not where it should be")
      // What would not be smaller compressed is not, which the decoder doesn't know of every kind
      val isPlain = length == part.bytes(width, height)
      Exr.read(parts.of(read(offset + ExrLevels.ChunkStart, length).array, width, height, isPlain))
    catch
      case e: IOException => throw ImageError(Code.Unreadable, s"$file: ${IoReason(e)}")
      case e: ImageError => throw damaged(level, x, y, e.getMessage)

  private def damaged(level: Int, x: Int, y: Int, reason: String) =
    ImageError(Code.DamagedImage, s"$file: tile $x, $y of level $level: $reason")

  private def read(at: Long, length: Int): ByteBuffer = ExrLevels.read(channel, at, length)

object ExrLevels:
  private val ChunkStart = 20
  private val Beginning = 1 << 16

  /** Texels of the largest tiles that are read alone. */
  private val MaxTileTexels = 1 << 16

  /** The levels of a file.
    *
    * @return None if it has none, or is damaged; else a reason why they can't be read one by one
    */
  def of(file: InputFile): Option[Either[String, ExrLevels]] =
    try
      val start = file.beginning(Beginning)
      if !start.startsWith(ImageFiles.ExrMark) then None
      else
        val (parts, table) = ExrHeader.ofBeginning(start)
        val part = parts.head
        for tiling <- part.tiling if tiling.hasLevels && part.obstacle.isEmpty
        yield obstacle(parts, part, tiling).toLeft(opened(file, start, part, tiling, table))
    catch case _: IOException | _: ImageError => None

  private def obstacle(
      parts: Vector[ExrPart],
      part: ExrPart,
      tiling: ExrTiling
  ): Option[String] =
    val isPowers = Integer.bitCount(part.width) == 1 && Integer.bitCount(part.height) == 1
    if parts.size > 1 then Some("the file has several parts")
    else if tiling.levelMode != 1 then Some("they are those of a RIP map, not of a MIP map")
    else if !isPowers then Some(s"${part.width}×${part.height} texels are no powers of two")
    else if tiling.width.toLong * tiling.height > MaxTileTexels then
      Some(s"its tiles of ${tiling.width}×${tiling.height} texels have more than $MaxTileTexels")
    else None

  private def opened(
      file: InputFile,
      start: Array[Byte],
      part: ExrPart,
      tiling: ExrTiling,
      table: Int
  ): ExrLevels =
    val channel = file.channel()
    try
      val count = tiling.tiles(part.width, part.height)
      if count > Int.MaxValue / 8 then throw IOException("too many tiles")
      val numbers = read(channel, table, 8 * count.toInt).asLongBuffer
      val offsets = Array.fill(count.toInt)(numbers.get())
      val dataStart = table + 8L * count
      if offsets.exists(o => o < dataStart || o > channel.size - ChunkStart) then
        throw IOException("tiles are missing")
      ExrLevels(file, channel, part, tiling, ExrTileFile(start, table, tiling), offsets)
    catch
      case e: Throwable =>
        channel.close()
        throw e

  private def read(channel: FileChannel, at: Long, length: Int): ByteBuffer =
    val bytes = ByteBuffer.allocate(length).order(ByteOrder.LITTLE_ENDIAN)
    while bytes.hasRemaining && channel.read(bytes, at + bytes.position()) >= 0 do ()
    if bytes.hasRemaining then throw IOException("the file ends early")
    bytes.flip()

/** Makes files of one tile each from tiles of a file, since the decoder reads files.
  *
  * @param start of that file
  * @param table where its headers end
  */
private final class ExrTileFile(start: Array[Byte], table: Int, tiling: ExrTiling):
  // The windows and the tiling are each tile's own, and neither levels nor their number matter
  private val header = start.take(table)
  private val values = ExrWindow.valueOffsets(header)

  /** @param isPlain whether the pixels are not compressed */
  def of(data: Array[Byte], width: Int, height: Int, isPlain: Boolean): Array[Byte] =
    val file = ByteBuffer.allocate(table + 28 + data.length).order(ByteOrder.LITTLE_ENDIAN)
    file.put(header)
    for name <- Vector("dataWindow", "displayWindow"); at <- values.get(name) do
      for (value, i) <- Vector(0, 0, width - 1, height - 1).zipWithIndex do
        file.putInt(at + 4 * i, value): Unit
    for at <- values.get("tiles") do
      file.putInt(at, tiling.width).putInt(at + 4, tiling.height).put(at + 8, 0.toByte): Unit
    if isPlain then for at <- values.get("compression") do file.put(at, 0.toByte): Unit
    for at <- values.get("chunkCount") do file.putInt(at, 1): Unit
    file.putLong(table + 8L)
    for _ <- 0 until 4 do file.putInt(0)
    file.putInt(data.length).put(data)
    file.array

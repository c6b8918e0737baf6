package candela.textures

import candela.base.loop
import candela.concurrency.DirectBuffers
import java.nio.ByteBuffer
import java.nio.channels.FileChannel

import candela.color.Rgb

/** Writes all levels of an image in tiles, while few rows of each are in memory: the numbers of
  * [[Pyramid.levels]].
  */
private[textures] final class TileWriter private (
    out: TileStream,
    layouts: Vector[TileLayout],
    texels: MadeTexels,
    wrap: Wrap
):
  private val channels = texels.bands.channels

  // The smallest levels are in one tile together
  private val tail = layouts.last.start
  private val isShared = layouts.map(p => p.start == tail && layouts.count(_.start == tail) > 1)
  private val shared = new Array[Int](TileMemory.Ints)
  private val alone = new Array[Int](TileMemory.Ints)

  private val levels = Array.tabulate(layouts.size)(LevelRows(_))

  private def write(): TexelFacts =
    val candidates = Vector.newBuilder[Rgb]
    var odd: Option[OddTexel] = None
    val bands =
      // Rows across whose edges the octahedral square goes on are far away
      if isEnlarged && wrap == Wrap.OctahedralSphere then TexelBands.of(texels.bands.inMemory)
      else texels.bands
    def note(y: Int, band: Texels): Unit =
      for c <- texels.colors do candidates ++= c.candidates(band, y.toLong * band.width)
      if odd.isEmpty then odd = band.odd.map(o => o.copy(y = y + o.y))
    if isEnlarged then enlarge(bands, note)
    else
      bands.visit(0): (y, band) =>
        note(y, band)
        store(y, band)
    if isShared.last then out.append(tail, shared)
    out.end()
    TexelFacts(texels.colors.fold(Vector.empty)(_.choose(candidates.result())), odd)

  private def isEnlarged =
    layouts(0).width != texels.bands.width || layouts(0).height != texels.bands.height

  /** A band as it is, and its reductions. */
  private def store(first: Int, band: Texels): Unit =
    storeTiles(0, first, band)
    if layouts.size > 1 then
      val row = new Array[Float](band.width * channels)
      loop(band.height): y =>
        band.row(y, row)
        levels(0).reduce(first + y, row)

  private def enlarge(bands: TexelBands, note: (Int, Texels) => Unit): Unit =
    val enlargement =
      Enlargement(bands.width, bands.height, channels, wrap, texels.maxValue.getOrElse(1f))
    val window = EdgedRows(bands.height, enlargement.length)
    val source = new Array[Float](bands.width * channels)
    def widen(first: Int, band: Texels, y: Int): Unit =
      band.row(y - first, source)
      window.clear(y)
      enlargement.widen(y, source, window.values, window.offsetOf(y)): (i, c) =>
        if band.height == bands.height then band(i, c)
        else source(i % bands.width * channels + c)
    def rows(first: Int, band: Texels, from: Int)(visit: Int => Unit): Unit =
      loop(band.height)(y => if first + y >= from then visit(first + y))
    val bottomRow = Math.max(0, bands.height - 2)
    if wrap.repeatsDown then
      bands.visit(bottomRow)((first, band) => rows(first, band, bottomRow)(widen(first, band, _)))
    val row = new Array[Float](enlargement.length)
    var nextRow = 0
    bands.visit(0): (first, band) =>
      note(first, band)
      rows(first, band, 0): y =>
        widen(first, band, y)
        while nextRow < enlargement.height && enlargement.lastOf(nextRow) <= y do
          java.util.Arrays.fill(row, 0f)
          enlargement.heighten(nextRow, window.values, row, 0)(window.offsetOf)
          levels(0).add(nextRow, row)
          nextRow += 1

  /** Writes rows of a level, which begin with a row of tiles and end with one, or the image. */
  private def storeTiles(level: Int, first: Int, texels: Texels): Unit =
    val layout = layouts(level)
    loop((texels.height - 1 >> layout.down) + 1): r =>
      val row = (first >> layout.down) + r
      loop(layout.tiles): column =>
        val tile = row * layout.tiles + column
        val into = if isShared(level) then shared else alone
        if !isShared(level) then java.util.Arrays.fill(into, 0)
        TilePacker.pack(layout, texels, first, tile, into)
        if !isShared(level) then out.append(layout.start + tile, into)

  /** Rows of a level on their way to its tiles, and to the next level. */
  private final class LevelRows(level: Int):
    private val layout = layouts(level)
    private val rows = Math.min(1 << layout.down, layout.height)
    private val length = layout.width * channels
    private lazy val values = new Array[Float](rows * length)
    private lazy val upper = new Array[Float](length)
    private lazy val halved = new Array[Float](Math.max(1, layout.width / 2) * channels)

    /** Adds a row, which is the next. */
    def add(y: Int, row: Array[Float]): Unit =
      val rowInTile = y % (1 << layout.down)
      System.arraycopy(row, 0, values, rowInTile * length, length)
      if rowInTile == rows - 1 || y == layout.height - 1 then
        storeTiles(level, y - rowInTile, FloatTexels(layout.width, rowInTile + 1, channels, values))
      reduce(y, row)

    /** Makes the next level's row of this and the one before. */
    def reduce(y: Int, row: Array[Float]): Unit =
      if level + 1 < layouts.size then
        if layout.height > 1 && y % 2 == 0 then System.arraycopy(row, 0, upper, 0, length)
        else
          val above = if layout.height > 1 then upper else row
          Pyramid.halve(above, row, layout.width, channels, halved, 0)
          levels(level + 1).add(y / 2, halved)

private[textures] object TileWriter:

  /** Writes tiles from a place in the file on. */
  def write(
      channel: FileChannel,
      start: Long,
      layouts: Vector[TileLayout],
      texels: MadeTexels,
      wrap: Wrap
  ): TexelFacts =
    TileStream.Buffers.lend: buffer =>
      new TileWriter(TileStream(channel, start, buffer), layouts, texels, wrap).write()

/** Writes tiles with their checksums, several at once where they follow each other. */
private final class TileStream(channel: FileChannel, start: Long, buffer: ByteBuffer):
  private var firstTile = 0
  private var count = 0

  def append(tile: Int, ints: Array[Int]): Unit =
    if count == TileStream.Together || tile != firstTile + count then end()
    if count == 0 then firstTile = tile
    val offset = buffer.position()
    buffer.asIntBuffer.put(ints)
    val sum = TileRecord.seal(buffer.duplicate().position(offset).limit(offset + TileRecord.Data))
    buffer.position(offset + TileRecord.Data).putInt(sum)
    count += 1

  /** Writes what is left. */
  def end(): Unit =
    buffer.flip()
    val fileOffset = start + firstTile.toLong * TileRecord.Bytes
    while buffer.hasRemaining do channel.write(buffer, fileOffset + buffer.position()): Unit
    buffer.clear(): Unit
    count = 0

private object TileStream:
  private val Together = 64
  val Buffers: DirectBuffers = DirectBuffers(Together * TileRecord.Bytes)

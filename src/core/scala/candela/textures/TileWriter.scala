package candela.textures

import java.nio.ByteBuffer
import java.nio.channels.FileChannel

import candela.base.{DirectBuffers, loop}
import candela.color.Rgb

/** Writes all levels of an image in tiles, while few rows of each are in memory: the numbers of
  * [[Pyramid.levels]].
  */
private[textures] final class TileWriter private (
    out: TileStream,
    places: Vector[TilePlace],
    made: MadeTexels,
    wrap: Wrap
):
  private val channels = made.bands.channels

  // The smallest levels are in one tile together
  private val tail = places.last.start
  private val isShared = places.map(p => p.start == tail && places.count(_.start == tail) > 1)
  private val shared = new Array[Int](TileMemory.Ints)
  private val alone = new Array[Int](TileMemory.Ints)

  private val levels = Array.tabulate(places.size)(LevelRows(_))

  private def write(): TexelFacts =
    val seen = Vector.newBuilder[Rgb]
    var odd: Option[OddTexel] = None
    val bands =
      // Rows across whose edges the octahedral square goes on are far away
      if isEnlarged && wrap == Wrap.OctahedralSphere then TexelBands.of(made.bands.whole)
      else made.bands
    def note(y: Int, band: Texels): Unit =
      for c <- made.colors do seen ++= c.seen(band, y.toLong * band.width)
      if odd.isEmpty then odd = band.odd.map(o => o.copy(y = y + o.y))
    if isEnlarged then enlarge(bands, note)
    else
      bands.visit(0): (y, band) =>
        note(y, band)
        store(y, band)
    if isShared.last then out.put(tail, shared)
    out.end()
    TexelFacts(made.colors.fold(Vector.empty)(_.choose(seen.result())), odd)

  private def isEnlarged =
    places(0).width != made.bands.width || places(0).height != made.bands.height

  /** A band as it is, and its reductions. */
  private def store(first: Int, band: Texels): Unit =
    put(0, first, band)
    if places.size > 1 then
      val row = new Array[Float](band.width * channels)
      loop(band.height): y =>
        band.row(y, row)
        levels(0).reduce(first + y, row)

  private def enlarge(bands: TexelBands, note: (Int, Texels) => Unit): Unit =
    val way = Enlargement(bands.width, bands.height, channels, wrap, made.most.getOrElse(1f))
    val kept = EdgedRows(bands.height, way.length)
    val source = new Array[Float](bands.width * channels)
    def widen(first: Int, band: Texels, y: Int): Unit =
      band.row(y - first, source)
      kept.clear(y)
      way.widen(y, source, kept.values, kept.at(y)): (i, c) =>
        if band.height == bands.height then band(i, c)
        else source(i % bands.width * channels + c)
    def rows(first: Int, band: Texels, from: Int)(visit: Int => Unit): Unit =
      loop(band.height)(y => if first + y >= from then visit(first + y))
    val last = Math.max(0, bands.height - 2)
    if wrap == Wrap.Repeat then
      bands.visit(last)((first, band) => rows(first, band, last)(widen(first, band, _)))
    val row = new Array[Float](way.length)
    var next = 0
    bands.visit(0): (first, band) =>
      note(first, band)
      rows(first, band, 0): y =>
        widen(first, band, y)
        while next < way.height && way.lastOf(next) <= y do
          java.util.Arrays.fill(row, 0f)
          way.heighten(next, kept.values, row, 0)(kept.at)
          levels(0).add(next, row)
          next += 1

  /** Writes rows of a level, which begin with a row of tiles and end with one, or the image. */
  private def put(level: Int, first: Int, texels: Texels): Unit =
    val place = places(level)
    loop((texels.height - 1 >> place.down) + 1): r =>
      val row = (first >> place.down) + r
      loop(place.tiles): column =>
        val tile = row * place.tiles + column
        val into = if isShared(level) then shared else alone
        if !isShared(level) then java.util.Arrays.fill(into, 0)
        TilePacker.pack(place, texels, first, tile, into)
        if !isShared(level) then out.put(place.start + tile, into)

  /** Rows of a level on their way to its tiles, and to the next level. */
  private final class LevelRows(level: Int):
    private val place = places(level)
    private val rows = Math.min(1 << place.down, place.height)
    private val length = place.width * channels
    private lazy val values = new Array[Float](rows * length)
    private lazy val upper = new Array[Float](length)
    private lazy val half = new Array[Float](Math.max(1, place.width / 2) * channels)

    /** Adds a row, which is the next. */
    def add(y: Int, row: Array[Float]): Unit =
      val at = y % (1 << place.down)
      System.arraycopy(row, 0, values, at * length, length)
      if at == rows - 1 || y == place.height - 1 then
        put(level, y - at, FloatTexels(place.width, at + 1, channels, values))
      reduce(y, row)

    /** Makes the next level's row of this and the one before. */
    def reduce(y: Int, row: Array[Float]): Unit =
      if level + 1 < places.size then
        if place.height > 1 && y % 2 == 0 then System.arraycopy(row, 0, upper, 0, length)
        else
          val above = if place.height > 1 then upper else row
          Pyramid.halve(above, row, place.width, channels, half, 0)
          levels(level + 1).add(y / 2, half)

private[textures] object TileWriter:

  /** Writes tiles from a place in the file on. */
  def write(
      channel: FileChannel,
      start: Long,
      places: Vector[TilePlace],
      made: MadeTexels,
      wrap: Wrap
  ): TexelFacts =
    TileStream.Buffers.lend: buffer =>
      new TileWriter(TileStream(channel, start, buffer), places, made, wrap).write()

/** Writes tiles with their checksums, several at once where they follow each other. */
private final class TileStream(channel: FileChannel, start: Long, some: ByteBuffer):
  private var first = 0
  private var count = 0

  def put(tile: Int, ints: Array[Int]): Unit =
    if count == TileStream.Together || tile != first + count then end()
    if count == 0 then first = tile
    val at = some.position()
    some.asIntBuffer.put(ints)
    val sum = TileRecord.seal(some.duplicate().position(at).limit(at + TileRecord.Data))
    some.position(at + TileRecord.Data).putInt(sum)
    count += 1

  /** Writes what is left. */
  def end(): Unit =
    some.flip()
    val at = start + first.toLong * TileRecord.Bytes
    while some.hasRemaining do channel.write(some, at + some.position()): Unit
    some.clear(): Unit
    count = 0

private object TileStream:
  private val Together = 64
  val Buffers: DirectBuffers = DirectBuffers(Together * TileRecord.Bytes)

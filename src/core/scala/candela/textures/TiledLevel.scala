package candela.textures

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** An image in tiles, of which a [[TileMemory]] holds some. */
private[textures] final class TiledImage(
    private[textures] val memory: TileMemory,
    source: TileSource,
    count: Int
):
  private val firstNumber = memory.numbers(count)

  // Slots + 1. Written without order: what a slot holds, its stamp tells
  private val pages = new Array[Int](count)

  /** The slot that the tile was in, or −1. */
  def slot(tile: Int): Int = pages(tile) - 1

  /** The number of a tile in the memory. */
  def number(tile: Int): Int = firstNumber + tile

  /** One of a tile's numbers. */
  def value(tile: Int, at: Int): Int =
    val slot = pages(tile) - 1
    val stamp = if slot < 0 then 0L else memory.stamp(slot)
    if TileMemory.holder(stamp) == firstNumber + tile then
      val texelValue = memory.ints(slot)(at)
      if memory.isStill(slot, stamp) then texelValue else load(tile, at)
    else load(tile, at)

  private def load(tile: Int, at: Int): Int =
    memory.load(source, tile, firstNumber + tile, pages, at)

/** A level whose texels are in tiles. A texel's index is that of its tile, and its place there.
  *
  * @param meaning of bytes; empty if the texels are Floats
  */
private[textures] final class TiledLevel(
    image: TiledImage,
    layout: TileLayout,
    wrap: Wrap,
    channels: Int,
    meaning: Array[Float]
) extends MipLevel(layout.width, layout.height, channels == 1):
  private val memory = image.memory
  private val isBytes = meaning.nonEmpty
  private val (across, down, start, base) = (layout.across, layout.down, layout.start, layout.base)
  private val tiles = layout.tiles
  private val (inRow, inColumn) = ((1 << across) - 1, (1 << down) - 1)
  private val (bits, inTile) = (across + down, (1 << (across + down)) - 1)

  def index(x: Int, y: Int): Int =
    if x >= 0 && y >= 0 && x < width && y < height then address(x, y)
    else
      val i = wrap.index(x, y, width, height)
      if i < 0 then -1 else address(i % width, i / width)

  private def address(x: Int, y: Int): Int =
    ((y >> down) * tiles + (x >> across)) << bits | (y & inColumn) << across | x & inRow

  def apply(index: Int, channel: Int): Float =
    if index < 0 then 0f
    else
      val k = base + (index & inTile) * channels + channel
      val value = image.value(start + (index >>> bits), if isBytes then k >> 2 else k)
      if isBytes then meaning(value >>> ((k & 3) << 3) & 0xff)
      else java.lang.Float.intBitsToFloat(value)

  override def tile: (Int, Int) = (1 << across, 1 << down)
  override def reader: TexelReader = TileReader()

  /** Keeps the tile of the latest texel at hand. */
  private final class TileReader extends TexelReader:
    private var tile = -1
    private var slot = 0
    private var stamp = 0L
    private var ints = TiledLevel.NoInts

    def apply(index: Int, channel: Int): Float =
      if index < 0 then 0f
      else
        val wantedTile = start + (index >>> bits)
        if wantedTile != tile then turn(wantedTile)
        val k = base + (index & inTile) * channels + channel
        if tile == wantedTile then
          val texelValue = value(ints, k)
          if memory.isStill(slot, stamp) then texelValue else missing(index, channel)
        else missing(index, channel)

    private def turn(wantedTile: Int): Unit =
      slot = image.slot(wantedTile)
      stamp = if slot < 0 then 0L else memory.stamp(slot)
      if TileMemory.holder(stamp) == image.number(wantedTile) then
        tile = wantedTile
        ints = memory.ints(slot)
      else tile = -1

    private def missing(index: Int, channel: Int): Float =
      tile = -1
      TiledLevel.this(index, channel)

  /** As of any level, at once if its tile is there. */
  override def texel(index: Int): Rgb =
    if isGray || index < 0 then super.texel(index)
    else
      val tile = start + (index >>> bits)
      val slot = image.slot(tile)
      val stamp = if slot < 0 then 0L else memory.stamp(slot)
      if TileMemory.holder(stamp) != image.number(tile) then super.texel(index)
      else
        val ints = memory.ints(slot)
        val k = base + (index & inTile) * channels
        val color = Rgb(value(ints, k), value(ints, k + 1), value(ints, k + 2))
        if memory.isStill(slot, stamp) then color else super.texel(index)

  /** As of any level, at once if the four texels are in one tile that is there. */
  override def addBilinear(s: Float, row: Float, weight: Float, sum: MutableRgb): Unit =
    val x = MipLevel.clampCoordinate(s * width - 0.5f)
    val y = MipLevel.clampCoordinate(row * height - 0.5f)
    val x0 = MipLevel.floor(x)
    val y0 = MipLevel.floor(y)
    val isInside = x0 >= 0 && y0 >= 0 && x0 < width - 1 && y0 < height - 1 &&
      (x0 & inRow) != inRow && (y0 & inColumn) != inColumn
    if !isInside then super.addBilinear(s, row, weight, sum)
    else
      val tile = start + (y0 >> down) * tiles + (x0 >> across)
      val slot = image.slot(tile)
      val stamp = if slot < 0 then 0L else memory.stamp(slot)
      if TileMemory.holder(stamp) != image.number(tile) then super.addBilinear(s, row, weight, sum)
      else
        val ints = memory.ints(slot)
        val k = base + ((y0 & inColumn) << across | x0 & inRow) * channels
        val dx = x - x0
        val dy = y - y0
        val r = weight * blend(ints, k, dx, dy)
        val g = if isGray then r else weight * blend(ints, k + 1, dx, dy)
        val b = if isGray then r else weight * blend(ints, k + 2, dx, dy)
        if memory.isStill(slot, stamp) then sum.add(r, g, b)
        else super.addBilinear(s, row, weight, sum)

  private def blend(ints: Array[Int], k: Int, dx: Float, dy: Float): Float =
    val below = k + (channels << across)
    lerp(
      dy,
      lerp(dx, value(ints, k), value(ints, k + channels)),
      lerp(dx, value(ints, below), value(ints, below + channels))
    )

  private def value(ints: Array[Int], k: Int): Float =
    if isBytes then meaning(ints(k >> 2) >>> ((k & 3) << 3) & 0xff)
    else java.lang.Float.intBitsToFloat(ints(k))

private object TiledLevel:
  private val NoInts = Array.emptyIntArray

/** Where a level's texels are in the tiles of an image.
  *
  * @param across, down binary logarithms of a tile's width and height, in texels
  * @param start  its first tile; rows of `tiles` tiles follow
  * @param base   of its first number in that tile
  */
private[textures] final case class TileLayout(
    width: Int,
    height: Int,
    isBytes: Boolean,
    across: Int,
    down: Int,
    start: Int,
    base: Int = 0
):
  val tiles: Int = (width - 1 >> across) + 1
  def count: Int = tiles * ((height - 1 >> down) + 1)

private[textures] object TileLayout:

  /** Places of the levels of an image, the largest first. The smallest are in one tile together. */
  def ofLevels(sizes: Vector[(Int, Int, Boolean)], channels: Int): Vector[TileLayout] =
    val numbers = sizes.map((w, h, isBytes) => if isBytes then Large else w.toLong * h * channels)
    val isPowers = sizes.forall((w, h, _) => Integer.bitCount(w) == 1 && Integer.bitCount(h) == 1)
    val tail =
      if isPowers then sizes.indices.find(i => numbers.drop(i).sum <= TileMemory.Ints)
      else None
    val separateLevels = tail.getOrElse(sizes.size)
    val large = sizes.take(separateLevels).foldLeft(Vector.empty[TileLayout]):
      case (previous, (w, h, isBytes)) =>
        val (across, down) = shape(channels, isBytes)
        previous :+ TileLayout(w, h, isBytes, across, down, previous.lastOption.fold(0)(end))
    val start = large.lastOption.fold(0)(end)
    val bases = numbers.drop(separateLevels).scanLeft(0L)(_ + _)
    large ++ sizes.drop(separateLevels).zip(bases).map:
      case ((w, h, _), base) =>
        val (across, down) = (Integer.numberOfTrailingZeros(w), Integer.numberOfTrailingZeros(h))
        TileLayout(w, h, isBytes = false, across, down, start, base.toInt)

  /** The number of tiles. */
  def count(layouts: Vector[TileLayout]): Int = end(layouts.last)

  private def end(layout: TileLayout): Int = layout.start + layout.count

  /** Of tiles that hold [[TileMemory.Ints]] numbers at most. */
  private def shape(channels: Int, isBytes: Boolean): (Int, Int) =
    (channels, isBytes) match
      case (1, true) => (7, 6)
      case (1, false) => (6, 5)
      case (_, true) => (6, 6)
      case (_, false) => (5, 5)

  private val Large = 1L << 32

package candela.textures

import candela.base.loop
import candela.diagnostics.{Problem, SceneError}
import candela.image.{ExrLevels, Image, ImageError}

/** The levels that an image file has itself, as they are: Floats, read tile by tile.
  *
  * @param picked the channels of colours, or one three times: they are grey then
  */
final class FileLevels(file: ExrLevels, picked: Vector[Int]):
  val channels: Int = if picked.distinct.size == 1 then 1 else 3
  private val sourceChannels = picked.take(channels).toArray

  /** Width and height of each level, the largest first, and that it has no bytes. */
  val sizes: Vector[(Int, Int, Boolean)] = file.sizes.map((w, h) => (w, h, false))

  /** A level in memory.
    *
    * @throws ImageError if a tile is damaged
    */
  def texels(level: Int): Texels =
    val (w, h) = file.sizes(level)
    val values = new Array[Float](Image.valueCount(w, h, channels))
    region(0, 0, w, h)(file.tile(level, _, _)): (x, y, c, value) =>
      values((y * w + x) * channels + c) = value
    FloatTexels(w, h, channels, values)

  /** In tiles of a memory. */
  private[textures] def source: TileSource = new TileSource:
    private val layouts = TileLayout.ofLevels(sizes, channels)

    def fill(tile: Int, buffer: TileBuffer): Unit =
      java.util.Arrays.fill(buffer.ints, 0)
      loop(layouts.size): level =>
        val layout = layouts(level)
        val local = tile - layout.start
        if local >= 0 && local < layout.count then
          val x0 = local % layout.tiles << layout.across
          val y0 = local / layout.tiles << layout.down
          val x1 = Math.min(layout.width, x0 + (1 << layout.across))
          val y1 = Math.min(layout.height, y0 + (1 << layout.down))
          region(x0, y0, x1, y1)(decoded(buffer, level, _, _)): (x, y, c, value) =>
            val offset = layout.base + ((y - y0 << layout.across) + x - x0) * channels + c
            buffer.ints(offset) = java.lang.Float.floatToRawIntBits(value)

  /** A tile of the file, unless the buffer has it: its neighbours in memory are often next. */
  private def decoded(buffer: TileBuffer, level: Int, x: Int, y: Int): Image =
    val tile = buffer.decoded
    if tile != null && (tile.file eq file) && tile.level == level && tile.x == x && tile.y == y
    then tile.image
    else
      val image =
        try file.tile(level, x, y)
        catch case e: ImageError => throw SceneError(Problem.general(e.code, e.getMessage))
      buffer.decoded = DecodedTile(file, level, x, y, image)
      image

  /** Visits the texels of a part of a level, x from `x0` until `x1`, y likewise. */
  private inline def region(x0: Int, y0: Int, x1: Int, y1: Int)(
      inline tile: (Int, Int) => Image
  )(inline put: (Int, Int, Int, Float) => Unit): Unit =
    val (w, h) = (file.tileWidth, file.tileHeight)
    var ty = y0 / h
    while ty * h < y1 do
      var tx = x0 / w
      while tx * w < x1 do
        val image = tile(tx, ty)
        var y = Math.max(y0, ty * h)
        while y < Math.min(y1, ty * h + h) do
          var x = Math.max(x0, tx * w)
          while x < Math.min(x1, tx * w + w) do
            var c = 0
            while c < channels do
              put(x, y, c, image(x - tx * w, y - ty * h, sourceChannels(c)))
              c += 1
            x += 1
          y += 1
        tx += 1
      ty += 1

/** A tile of an image file. */
private[textures] final case class DecodedTile(
    file: ExrLevels,
    level: Int,
    x: Int,
    y: Int,
    image: Image
)

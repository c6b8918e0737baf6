package candela.render

/** Waves over the tiles of an image, row by row. */
private[render] final class Schedule(
    crop: PixelBounds,
    samplesPerPixel: Int,
    largestWave: Int = Waves.Largest
) extends Waves(Schedule.tiles(crop), samplesPerPixel, largestWave):
  def tile(index: Int): PixelBounds = Schedule.tile(crop, index)

private[render] object Schedule:

  /** Pixels along a tile's edge: small enough that all workers end at about the same time. */
  val TileSize: Int = 16

  /** All tiles of an image, in their order. */
  def tilesOf(crop: PixelBounds): Vector[PixelBounds] =
    Vector.tabulate(tiles(crop))(tile(crop, _))

  private def tile(crop: PixelBounds, index: Int): PixelBounds =
    val x = crop.x0 + index % columns(crop) * TileSize
    val y = crop.y0 + index / columns(crop) * TileSize
    PixelBounds(x, y, Math.min(x + TileSize, crop.x1), Math.min(y + TileSize, crop.y1))

  private def columns(crop: PixelBounds): Int = (crop.width + TileSize - 1) / TileSize
  private def rows(crop: PixelBounds): Int = (crop.height + TileSize - 1) / TileSize
  private def tiles(crop: PixelBounds): Int = Math.multiplyExact(columns(crop), rows(crop))

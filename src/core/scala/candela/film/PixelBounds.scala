package candela.film

/** Pixels of the full image, as half-open ranges: x0 ≤ x < x1, y0 ≤ y < y1. */
final case class PixelBounds(x0: Int, y0: Int, x1: Int, y1: Int):
  def width: Int = x1 - x0
  def height: Int = y1 - y0
  def pixels: Long = width.toLong * height

  /** Those of these pixels that are in `other`, too. */
  def intersection(other: PixelBounds): PixelBounds =
    PixelBounds(
      Math.max(x0, other.x0),
      Math.max(y0, other.y0),
      Math.min(x1, other.x1),
      Math.min(y1, other.y1)
    )

  /** With so many more pixels on either side. */
  def widened(x: Int, y: Int): PixelBounds = PixelBounds(x0 - x, y0 - y, x1 + x, y1 + y)

  def contains(x: Float, y: Float): Boolean = x >= x0 && x < x1 && y >= y0 && y < y1

package candela.film

/** Pixels of the full image, as half-open ranges: x0 ≤ x < x1, y0 ≤ y < y1. */
final case class PixelBounds(x0: Int, y0: Int, x1: Int, y1: Int):
  def width: Int = x1 - x0
  def height: Int = y1 - y0
  def pixels: Long = width.toLong * height

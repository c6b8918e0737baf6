package candela.film

/** A filter along one axis as a table, for those whose values take long to compute: linear between
  * points 1/64 pixel apart or closer. Immutable.
  *
  * Box and triangle filters it follows exactly, as they have their kinks at points of the table.
  */
final class FilterTable(radius: Float, filter: Float => Float):
  private val cells = FilterTable.cells(radius, FilterTable.CellsPerPixel)
  private val perPixel = cells / (2f * radius)
  private val values =
    Array.tabulate(cells + 1)(i => filter(FilterTable.place(radius, cells, i)))

  /** The filter `d` pixels from a pixel's centre; 0 beyond the radius. */
  def apply(d: Float): Float =
    val at = (d + radius) * perPixel
    if !(at >= 0f && at <= cells) then 0f
    else
      val cell = Math.min(at.toInt, cells - 1)
      val low = values(cell)
      low + (at - cell) * (values(cell + 1) - low)

private[film] object FilterTable:
  private val CellsPerPixel = 64

  /** Cells of [−radius, radius]: a multiple of four, so that the kinks that filters have at the
    * centre and half radius are ends of cells.
    */
  def cells(radius: Float, perPixel: Int): Int = (2 * radius * perPixel).ceil.toInt + 3 & ~3

  /** Where cell `i` of so many begins. */
  def place(radius: Float, cells: Int, i: Double): Float =
    Math.max(-radius, Math.min(radius, (radius * (2 * i / cells - 1)).toFloat))

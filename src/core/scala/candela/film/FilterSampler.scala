package candela.film

import candela.base.loop

/** Filter importance sampling: samples positions within a filter's extent, so that samples have
  * (almost) equal weights and each contributes to one pixel.
  *
  * Along each axis the pdf is proportional to |filter|, interpolated linearly between points 1/32
  * pixel apart or closer; exact for box and triangle filters. Mutable, one per worker.
  *
  * Source: Ernst, Stamminger, Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive
  * Ray Tracing 2006.
  */
final class FilterSampler private (
    filter: Filter,
    alongX: FilterSampler.Axis,
    alongY: FilterSampler.Axis
):
  def this(filter: Filter) = this(
    filter,
    FilterSampler.Axis.of(filter.radiusX, filter.x),
    FilterSampler.Axis.of(filter.radiusY, filter.y)
  )

  /** Offset of the last sample from the pixel centre, in pixels. */
  var dx, dy: Float = 0f

  /** filter / (pdf · integral of the filter): 1 on average, negative in negative lobes. */
  var weight: Float = 0f

  /** @param u1 uniform in [0, 1), as `u2` */
  def sample(u1: Float, u2: Float): Unit =
    dx = alongX.sample(u1)
    dy = alongY.sample(u2)
    weight = alongX.weight(dx, filter.x(dx)) * alongY.weight(dy, filter.y(dy))

  def copy(): FilterSampler = new FilterSampler(filter, alongX, alongY)

private object FilterSampler:

  /** A piecewise linear pdf on [−radius, radius], with `heights.length − 1` equal cells.
    *
    * @param heights  pdf at the ends of the cells
    * @param cdf      at the same points, from 0 to 1
    * @param integral of the signed filter
    */
  private final class Axis(
      radius: Float,
      heights: Array[Float],
      cdf: Array[Float],
      integral: Float
  ):
    private val cells = heights.length - 1
    private val cellWidth = 2f * radius / cells
    private val cellsPerPixel = cells / (2f * radius)

    def sample(u: Float): Float =
      val cell = search(u)
      val low = cdf(cell)
      val high = cdf(cell + 1)
      val v = if high > low then (u - low) / (high - low) else 0f
      val a = heights(cell)
      val b = heights(cell + 1)
      // Root of the quadratic CDF, in the form without cancellation.
      val root = Math.sqrt((1.0 - v) * a * a + v.toDouble * b * b).toFloat
      val t = if a + root > 0f then v * (a + b) / (a + root) else 0f
      Math.min(radius, (cell + t) * cellWidth - radius)

    def weight(d: Float, value: Float): Float =
      val position = (d + radius) * cellsPerPixel
      val cell = Math.min(position.toInt, cells - 1)
      val t = position - cell
      val density = (1f - t) * heights(cell) + t * heights(cell + 1)
      if density > 0f then value / (density * integral) else 0f

    /** Binary search: the last cell that begins at or before `u` in the CDF. */
    private def search(u: Float): Int =
      var low = 0
      var high = cells
      while high - low > 1 do
        val middle = (low + high) >>> 1
        if cdf(middle) <= u then low = middle else high = middle
      low

  private object Axis:
    private val CellsPerPixel = 32
    private val MinCells = 64

    /** Simpson intervals per cell for the filter's integral; the error is below Float precision for
      * functions as smooth as filters are within a cell.
      */
    private val Intervals = 8

    def of(radius: Float, filter: Float => Float): Axis =
      val cells = Math.max(MinCells, FilterTable.cells(radius, CellsPerPixel))
      def position(i: Double): Float = FilterTable.position(radius, cells, i)

      val heights = Array.tabulate(cells + 1)(i => Math.abs(filter(position(i))))
      val cumulative = new Array[Double](cells + 1)
      var integral = 0.0
      loop(cells): i =>
        cumulative(i + 1) = cumulative(i) + 0.5 * (heights(i).toDouble + heights(i + 1))
        integral += (0 to Intervals)
          .map: k =>
            val factor = if k == 0 || k == Intervals then 1 else if k % 2 == 1 then 4 else 2
            factor * filter(position(i + k.toDouble / Intervals)).toDouble
          .sum / (3 * Intervals)
      val area = cumulative(cells)
      require(area > 0 && integral > 0, "the filter's integral must be positive")
      val density = heights.map(h => (h / area).toFloat)
      Axis(radius, density, cumulative.map(c => (c / area).toFloat), integral.toFloat)

/** A filter tabulated along one axis, for filters that are expensive to evaluate: linear between
  * points 1/64 pixel apart or closer. Immutable.
  *
  * Exact for box and triangle filters, whose kinks are at table points.
  */
final class FilterTable(radius: Float, filter: Float => Float):
  private val cells = FilterTable.cells(radius, FilterTable.CellsPerPixel)
  private val perPixel = cells / (2f * radius)
  private val values =
    Array.tabulate(cells + 1)(i => filter(FilterTable.position(radius, cells, i)))

  /** Filter value `d` pixels from the pixel centre; 0 outside the radius. */
  def apply(d: Float): Float =
    val position = (d + radius) * perPixel
    if !(position >= 0f && position <= cells) then 0f
    else
      val cell = Math.min(position.toInt, cells - 1)
      val low = values(cell)
      low + (position - cell) * (values(cell + 1) - low)

private[film] object FilterTable:
  private val CellsPerPixel = 64

  /** Number of cells of [−radius, radius]: a multiple of four, so that filter kinks at the centre
    * and half radius are ends of cells.
    */
  def cells(radius: Float, perPixel: Int): Int = (2 * radius * perPixel).ceil.toInt + 3 & ~3

  /** Start of cell `i` of `cells`. */
  def position(radius: Float, cells: Int, i: Double): Float =
    Math.max(-radius, Math.min(radius, (radius * (2 * i / cells - 1)).toFloat))

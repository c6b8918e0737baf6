package candela.film

/** How far a filter lets a sample count, and how much: tables of its two axes. Immutable. */
final class FilterReach(filter: Filter):
  val radiusX: Float = filter.radiusX
  val radiusY: Float = filter.radiusY
  val x: FilterTable = FilterTable(radiusX, filter.x)
  val y: FilterTable = FilterTable(radiusY, filter.y)

  /** Pixels beyond its own, to either side, in which a sample may count. */
  val beyondX: Int = FilterReach.beyond(radiusX)
  val beyondY: Int = FilterReach.beyond(radiusY)

object FilterReach:
  private def beyond(radius: Float): Int = Math.ceil(radius - 0.5).toInt

  /** Is there any use in sharing samples by this filter? Not if all stay in their own pixel; nor if
    * it is so wide that the pixels around a tile would take more memory than those within.
    */
  def isUseful(filter: Filter): Boolean =
    val most = Math.max(beyond(filter.radiusX), beyond(filter.radiusY))
    most >= 1 && most <= Most

  private val Most = 8

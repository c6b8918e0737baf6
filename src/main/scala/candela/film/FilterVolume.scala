package candela.film

/** ∫ of a filter over its extent, by the midpoint rule along both axes. */
object FilterVolume:
  private val Steps = 4096

  def apply(filter: Filter): Double =
    along(filter.radiusX, filter.x) * along(filter.radiusY, filter.y)

  private def along(radius: Float, value: Float => Float): Double =
    (0 until Steps)
      .map(i => value(((2.0 * i + 1) / Steps - 1).toFloat * radius).toDouble)
      .sum * 2 * radius / Steps

package candela.measure

/** An estimate with its 95 % confidence interval; for a single measurement, the estimate alone
  * (`low` = `high` = NaN). An interval without an upper limit has an infinite one, and one without
  * a lower limit begins at 0.
  */
final case class Interval(estimate: Double, low: Double, high: Double):
  def isKnown: Boolean = !low.isNaN && !high.isNaN

  /** Does it have an upper limit? */
  def isBounded: Boolean = isKnown && !high.isInfinite

  /** Of the reciprocal, of a positive figure. */
  def inverse: Interval = Interval(1 / estimate, 1 / high, 1 / low)

  def *(factor: Double): Interval = Interval(estimate * factor, low * factor, high * factor)

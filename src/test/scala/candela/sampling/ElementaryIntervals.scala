package candela.sampling

/** The property that makes a (0,2)-net. */
object ElementaryIntervals:

  /** Has each rectangle of 2⁻ᵃ × 2⁻ᵇ, for all a + b = log₂ of the number of points, one of them? */
  def allHoldOne(points: IndexedSeq[(Float, Float)]): Boolean =
    val log = Integer.numberOfTrailingZeros(points.size)
    require(points.size == 1 << log, "no power of two")
    (0 to log).forall: a =>
      val (columns, rows) = (1 << a, 1 << (log - a))
      points.map((x, y) => ((x * columns).toInt, (y * rows).toInt)).distinct.size == points.size

  /** Has each of as many equal intervals as there are numbers one of them? */
  def eachHoldsOne(numbers: IndexedSeq[Float]): Boolean =
    numbers.map(u => (u.toDouble * numbers.size).toInt).distinct.size == numbers.size

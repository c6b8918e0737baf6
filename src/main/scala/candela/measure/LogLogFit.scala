package candela.measure

/** Straight lines through curves whose axes are both logarithmic. */
object LogLogFit:

  /** The slope by least squares; −1 for the squared error of independent samples. None if there are
    * fewer than two different places. Points that have no logarithm are left out.
    */
  def slope(points: Vector[(Double, Double)]): Option[Double] =
    val logs = points.collect { case (x, y) if x > 0 && y > 0 => (Math.log(x), Math.log(y)) }
    if logs.map(_._1).distinct.sizeIs < 2 then None
    else
      val meanX = logs.map(_._1).sum / logs.size
      val meanY = logs.map(_._2).sum / logs.size
      val together = logs.map((x, y) => (x - meanX) * (y - meanY)).sum
      Some(together / logs.map((x, _) => (x - meanX) * (x - meanX)).sum)

  /** Where the curve first comes down to `y`, by a straight line between the neighbours. None if it
    * doesn't: nothing is guessed beyond what was measured. A curve that begins below `y` was there
    * at its first point at the latest.
    */
  def firstAt(points: Vector[(Double, Double)], y: Double): Option[Double] =
    val curve = points.filter((x, e) => x > 0 && e > 0).sortBy(_._1)
    curve.indexWhere(_._2 <= y) match
      case -1 => None
      case 0 => Some(curve.head._1)
      case i =>
        val ((x0, y0), (x1, y1)) = (curve(i - 1), curve(i))
        val part = (Math.log(y0) - Math.log(y)) / (Math.log(y0) - Math.log(y1))
        Some(Math.exp(Math.log(x0) + part * (Math.log(x1) - Math.log(x0))))

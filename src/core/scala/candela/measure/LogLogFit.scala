package candela.measure

/** Fits of straight lines in log-log space. */
object LogLogFit:

  /** Least-squares slope; −1 for the squared error of independent samples. None for fewer than two
    * distinct abscissas. Ignores points without logarithm.
    */
  def slope(points: Vector[(Double, Double)]): Option[Double] =
    val logs = points.collect { case (x, y) if x > 0 && y > 0 => (Math.log(x), Math.log(y)) }
    if logs.map(_._1).distinct.sizeIs < 2 then None
    else
      val meanX = logs.map(_._1).sum / logs.size
      val meanY = logs.map(_._2).sum / logs.size
      val together = logs.map((x, y) => (x - meanX) * (y - meanY)).sum
      Some(together / logs.map((x, _) => (x - meanX) * (x - meanX)).sum)

  /** Ordinate at `x`, interpolated linearly between neighbours. None outside of the curve. */
  def at(points: Vector[(Double, Double)], x: Double): Option[Double] =
    val curve = points.filter((t, e) => t > 0 && e > 0).sortBy(_._1)
    curve.indexWhere(_._1 >= x) match
      case -1 => None
      case 0 => Option.when(curve.head._1 == x)(curve.head._2)
      case i =>
        val ((x0, y0), (x1, y1)) = (curve(i - 1), curve(i))
        val fraction = (Math.log(x) - Math.log(x0)) / (Math.log(x1) - Math.log(x0))
        Some(Math.exp(Math.log(y0) + fraction * (Math.log(y1) - Math.log(y0))))

  /** Abscissa where the curve first falls to `y`, interpolated linearly between neighbours. None if
    * it doesn't: no extrapolation. The first point if the curve starts below `y`, an upper bound.
    */
  def firstAt(points: Vector[(Double, Double)], y: Double): Option[Double] =
    val curve = points.filter((x, e) => x > 0 && e > 0).sortBy(_._1)
    curve.indexWhere(_._2 <= y) match
      case -1 => None
      case 0 => Some(curve.head._1)
      case i =>
        val ((x0, y0), (x1, y1)) = (curve(i - 1), curve(i))
        val fraction = (Math.log(y0) - Math.log(y)) / (Math.log(y0) - Math.log(y1))
        Some(Math.exp(Math.log(x0) + fraction * (Math.log(x1) - Math.log(x0))))

package candela.color

import candela.base.loop

/** Smooth spectra of colours that none has: those at which pbrt-v4's fit ends.
  *
  * The fit seeks the zero of the difference in CIELAB by Gauss's and Newton's method, and scales
  * the coefficients down whenever the largest exceeds 200. Where there is no zero, they settle at
  * that bound: not at the least difference, but at a spectrum that depends on colour and space
  * alone.
  *
  * Source: Jakob and Hanika; see [[Upsampling]].
  */
private[color] object GamutEdge:
  /** The bound of pbrt-v4's coefficients. It does not bound negative ones. */
  val Largest = 200.0

  /** Moves the coefficients of a spectrum, that of a near colour, to where the fit ends. */
  def settle(c: Array[Double], target: Array[Double], space: ColorSpace): Unit =
    val white = Array.tabulate(3)(k => space.illuminantXyz.map(_(k + 1)).sum)
    val xyz = space.xyzOfRgb * target.toVector
    val wanted = Array.tabulate(3)(k => lightness(xyz(k) / white(k)))
    val current = new Array[Double](3)
    val columns = Array.fill(3)(new Array[Double](3))
    var remaining = Iterations
    while remaining > 0 do
      remaining -= 1
      // CIELAB is linear in the three lightnesses: the step is the same
      slopes(c, space.illuminantXyz, current, columns)
      val residual = Array.tabulate(3): k =>
        val share = current(k) / white(k)
        (lightness(share) - wanted(k)) * white(k) / lightnessSlope(share)
      Upsampling.solve(columns, residual) match
        case None => remaining = 0
        case Some(step) =>
          val previous = c.clone()
          loop(3)(i => c(i) -= step(i))
          val maximum = Math.max(c(0), Math.max(c(1), c(2)))
          if maximum > Largest then loop(3)(i => c(i) *= Largest / maximum)
          if (0 until 3).forall(i => Math.abs(c(i) - previous(i)) < Settled) then remaining = 0

  private val Iterations = 60
  private val Settled = 1e-4

  /** X, Y and Z of the spectrum, and their derivatives by each coefficient. */
  private def slopes(
      c: Array[Double],
      rows: Array[Array[Double]],
      xyz: Array[Double],
      columns: Array[Array[Double]]
  ): Unit =
    java.util.Arrays.fill(xyz, 0.0)
    loop(3)(i => java.util.Arrays.fill(columns(i), 0.0))
    loop(rows.length): i =>
      val row = rows(i)
      val x = Upsampling.position(row(0).toFloat)
      val t = (c(0) * x + c(1)) * x + c(2)
      val root = 1 / Math.sqrt(1 + t * t)
      val slope = 0.5 * root * root * root
      loop(3): k =>
        val d = row(k + 1) * slope
        xyz(k) += row(k + 1) * (0.5 + 0.5 * t * root)
        columns(0)(k) += d * x * x
        columns(1)(k) += d * x
        columns(2)(k) += d

  /** CIE 15:2018, §8.2.1: the function of X, Y and Z over white's. */
  private def lightness(t: Double): Double =
    if t > Knee then Math.cbrt(t) else t / Linear + 4.0 / 29

  private def lightnessSlope(t: Double): Double =
    if t > Knee then 1 / (3 * Math.pow(Math.cbrt(t), 2)) else 1 / Linear

  private val Knee = Math.pow(6.0 / 29, 3)
  private val Linear = 3 * Math.pow(6.0 / 29, 2)

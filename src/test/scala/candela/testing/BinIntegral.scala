package candela.testing

/** Integrals over rectangles of densities that may have peaks and jumps: the 3 × 3 Gauss–Legendre
  * rule on ever smaller quarters, where they still change the result. The first cut is into 4 × 4
  * parts, so that a peak of an eighth of the side can't hide between the rule's points.
  */
final class BinIntegral(f: (Double, Double) => Double):

  /** The integral over [x, x + width] × [y, y + height]; to about 1e-7 where `f` is smooth and a
    * 2⁻⁹th of the jump across a discontinuity.
    */
  def apply(x: Double, y: Double, width: Double, height: Double): Double =
    val (w, h) = (width / 4, height / 4)
    (for i <- 0 until 4; j <- 0 until 4
    yield refined(
      x + i * w,
      y + j * h,
      w,
      h,
      rule(x + i * w, y + j * h, w, h),
      BinIntegral.Levels
    )).sum

  private def refined(
      x: Double,
      y: Double,
      w: Double,
      h: Double,
      whole: Double,
      levels: Int
  ): Double =
    val (hw, hh) = (w / 2, h / 2)
    val a = rule(x, y, hw, hh)
    val b = rule(x + hw, y, hw, hh)
    val c = rule(x, y + hh, hw, hh)
    val d = rule(x + hw, y + hh, hw, hh)
    val sum = a + b + c + d
    // 1e-9 in each of some 6000 first parts stays far below the noise of 1e6 draws, 1e-3
    if levels == 0 || Math.abs(sum - whole) < 1e-9 then sum
    else
      refined(x, y, hw, hh, a, levels - 1) + refined(x + hw, y, hw, hh, b, levels - 1) +
        refined(x, y + hh, hw, hh, c, levels - 1) + refined(x + hw, y + hh, hw, hh, d, levels - 1)

  private def rule(x: Double, y: Double, w: Double, h: Double): Double =
    var sum = 0.0
    var i = 0
    while i < 9 do
      val (p, q) = (i / 3, i % 3)
      sum += BinIntegral.weights(p) * BinIntegral.weights(q) *
        f(x + w * BinIntegral.nodes(p), y + h * BinIntegral.nodes(q))
      i += 1
    sum * w * h

object BinIntegral:
  private val Levels = 6
  private val nodes = Array(0.5 - Math.sqrt(0.15), 0.5, 0.5 + Math.sqrt(0.15))
  private val weights = Array(5.0 / 18, 8.0 / 18, 5.0 / 18)

package candela.math

/** One piece of a cubic spline, over t from 0 to 1.
  *
  * @param f0, f1 values at the ends
  * @param d0, d1 slopes there, by t
  */
final class CubicPiece(f0: Double, f1: Double, d0: Double, d1: Double):
  private val second = 3 * (f1 - f0) - 2 * d0 - d1
  private val third = d0 + d1 + 2 * (f0 - f1)

  def apply(t: Double): Double = f0 + t * (d0 + t * (second + t * third))

  def slope(t: Double): Double = d0 + t * (2 * second + t * 3 * third)

  /** ∫ from 0 to t. */
  def area(t: Double): Double = t * (f0 + t * (d0 / 2 + t * (second / 3 + t * third / 4)))

  /** Where the area from 0 on is `target`, if the piece is positive. */
  def whereAreaIs(target: Double): Double =
    // The first guess is right for a straight line
    val root = Math.sqrt(Math.max(0.0, f0 * f0 + 2 * target * (f1 - f0)))
    val first = if f0 != f1 then (f0 - root) / (f0 - f1) else target / f0
    solve(first, area(_) - target, apply(_))

  /** Where the value is `target`, if the piece rises. */
  def whereValueIs(target: Double): Double = solve(0.5, apply(_) - target, slope(_))

  /** The zero of a rising function, by Newton's method; by bisection where that leads astray. */
  private inline def solve(
      first: Double,
      inline f: Double => Double,
      inline slope: Double => Double
  ): Double =
    var low = 0.0
    var high = 1.0
    var t = first
    var residual = Double.PositiveInfinity
    while Math.abs(residual) > CubicPiece.Exact && high - low > CubicPiece.Near do
      if !(t >= low && t <= high) then t = 0.5 * (low + high)
      residual = f(t)
      if residual < 0 then low = t else high = t
      if Math.abs(residual) > CubicPiece.Exact then t -= residual / slope(t)
    if t >= low && t <= high then t else 0.5 * (low + high)

object CubicPiece:
  // Far below what a Float can tell apart
  private inline val Exact = 1e-12
  private inline val Near = 1e-9

package candela.math

// Sines and cosines of angles in known ranges, and the angles of vectors, without the calls, tests
// and reductions of the JVM's own, which took 5 % of a path through a box. Polynomials by Chebyshev
// interpolation.

/** Sine for |x| ≤ π/4, with a relative error of 5e-12. */
inline def sinOfEighth(inline x: Double): Double =
  val q = x * x
  x * ((((2.717345361627713e-6 * q - 1.9839202172159784e-4) * q + 8.33332878229936e-3) * q -
    0.16666666631589003) * q + 0.9999999999956726)

/** Cosine for |x| ≤ π/4, with an error of 5e-11. */
inline def cosOfEighth(inline x: Double): Double =
  val q = x * x
  (((2.4379830963894595e-5 * q - 1.3886617996113834e-3) * q + 4.166661669239419e-2) * q -
    0.4999999961485576) * q + 0.9999999999524889

/** Passes sine and cosine of `x`, from 0 to 2π, to `use`. Their errors are below 4e-9; that of the
  * sine is relative near 0.
  */
inline def sinCos[T](inline x: Double)(inline use: (Double, Double) => T): T =
  val eighth = 0.125 * x
  // Doubles the angle three times
  val s1 = sinOfEighth(eighth)
  val c1 = cosOfEighth(eighth)
  val s2 = 2.0 * s1 * c1
  val c2 = 1.0 - 2.0 * s1 * s1
  val s4 = 2.0 * s2 * c2
  val c4 = 1.0 - 2.0 * s2 * s2
  use(2.0 * s4 * c4, 1.0 - 2.0 * s4 * s4)

/** The angle from (1, 0) to the vector, 0 to 2π, with a relative error of 2e-12; 0 if both
  * coordinates are 0, NaN if one is.
  */
def angleOf(x: Double, y: Double): Double =
  val dx = Math.abs(x)
  val dy = Math.abs(y)
  val isSteep = dy > dx
  val longer = if isSteep then dy else dx
  val shorter = if isSteep then dx else dy
  if longer == 0.0 then 0.0
  else
    // From the nearer of the axis and the diagonal
    val isDiagonal = shorter > Tan8th * longer
    val t =
      if isDiagonal then (shorter - longer) / (shorter + longer) else shorter / longer
    val a = if isDiagonal then 0.25 * Math.PI + arctangent(t) else arctangent(t)
    val above = if isSteep then 0.5 * Math.PI - a else a
    val half = if x < 0.0 then Math.PI - above else above
    if y < 0.0 then 2.0 * Math.PI - half else half

/** Tangent of π/8. */
private inline val Tan8th = 0.41421356237309503

/** For |t| ≤ tan(π/8), with a relative error of 2e-12. */
private inline def arctangent(t: Double): Double =
  val q = t * t
  val q2 = q * q
  val low = 0.999999999998121 - 0.33333333254104086 * q +
    (0.19999991830839245 - 0.14285359518075763 * q) * q2
  val high = 0.11103174845692089 - 0.08991197302264252 * q +
    (0.06972015832055325 - 0.03766865052084524 * q) * q2
  t * (low + high * (q2 * q2))

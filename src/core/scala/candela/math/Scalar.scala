package candela.math

/** Float constants, and scalar functions missing from the standard library. */

inline val Pi = 3.14159265358979323846f
inline val TwoPi = 6.28318530717958647693f
inline val InvPi = 0.31830988618379067154f
inline val InvTwoPi = 0.15915494309189533577f

/** The largest Float below 1: the upper bound of uniform samples in [0, 1). */
inline val OneMinusEpsilon = 0.99999994f

/** What may have been rounded up to 1, within [0, 1) again. */
inline def belowOne(x: Float): Float = Math.min(x, OneMinusEpsilon)

/** Half the distance from 1 to the next Float: the unit round-off of Float arithmetic. */
inline val MachineEpsilon = 5.9604645e-8f

/** Bound of the relative error of `n` consecutive rounded operations.
  *
  * Source: Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., lemma 3.1.
  */
inline def gamma(inline n: Int): Float = (n * MachineEpsilon) / (1f - n * MachineEpsilon)

inline def square(x: Float): Float = x * x
inline def square(x: Double): Double = x * x
inline def sqrt(x: Float): Float = Math.sqrt(x.toDouble).toFloat

/** Square root of an argument that rounding may have made slightly negative. */
inline def safeSqrt(x: Float): Float = if x > 0f then sqrt(x) else 0f

inline def lerp(t: Float, a: Float, b: Float): Float = (1f - t) * a + t * b
inline def clamp(x: Float, low: Float, high: Float): Float =
  if x < low then low else if x > high then high else x
inline def clamp(x: Int, low: Int, high: Int): Int =
  if x < low then low else if x > high then high else x

inline def radians(degrees: Float): Float = degrees * (Pi / 180f)

inline def sin(x: Float): Float = Math.sin(x.toDouble).toFloat
inline def cos(x: Float): Float = Math.cos(x.toDouble).toFloat
inline def exp(x: Float): Float = Math.exp(x.toDouble).toFloat
inline def log(x: Float): Float = Math.log(x.toDouble).toFloat
inline def pow(x: Float, y: Float): Float = Math.pow(x.toDouble, y.toDouble).toFloat
inline def log2(x: Float): Float = (Math.log(x.toDouble) * 1.4426950408889634).toFloat
inline def abs(x: Float): Float = Math.abs(x)

/** The bits of |x|, which have the order of the Floats; NaN is above them. */
inline def magnitudeBits(x: Float): Int = java.lang.Float.floatToRawIntBits(x) & Int.MaxValue

/** `a·b − c·d` without cancellation: the error is at most 1.5 ulp.
  *
  * Source: Kahan's fused-multiply-add scheme; Jeannerod et al., "Further analysis of Kahan's
  * algorithm for the accurate computation of 2×2 determinants", Math. Comp. 82, 2013. Uses exact
  * Double products, which are the same on every JVM and need no FMA unit.
  */
inline def differenceOfProducts(a: Float, b: Float, c: Float, d: Float): Float =
  (a.toDouble * b.toDouble - c.toDouble * d.toDouble).toFloat

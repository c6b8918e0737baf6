package candela.color

/** Newton's method for the three coefficients of a smooth spectrum, from one colour to the next.
  * Mutable.
  *
  * @param responses red, green and blue of each of [[Colorimetry.wavelengths]]; a spectrum's colour
  *                  is their sum, weighted by it
  */
private[color] final class SpectrumFit(responses: Array[Double] = Colorimetry.shares):
  import SpectrumFit.*

  /** The coefficients. */
  val c: Array[Double] = Array(0.0, 0.0, 0.0)
  private val residual = Array(0.0, 0.0, 0.0)
  private val jacobian = new Array[Double](9)
  private val count = responses.length / 3

  def restart(): Unit = java.util.Arrays.fill(c, 0.0)

  /** Moves to a colour in the space of the responses, as close as a bounded spectrum comes in a few
    * steps.
    */
  def to(target: Array[Double]): Unit =
    var remaining = Iterations
    while remaining > 0 do
      remaining -= 1
      evaluate(target)
      if distance < 1e-5 then remaining = 0
      else step(Longest)

  /** Moves to a colour from that of a near one, until the coefficients have no error but rounding:
    * they then depend on the colour alone, not on the start. False, and anywhere, if it can't.
    */
  def reach(target: Array[Double]): Boolean = reach(target, Rounding)

  /** As above, with an error of at most `tolerance` in all channels together. */
  def reach(target: Array[Double], tolerance: Double): Boolean =
    var remaining = MaxSteps
    evaluate(target)
    while remaining > 0 && !(distance < tolerance) do
      remaining -= 1
      step(LongestReach)
      evaluate(target)
    distance < tolerance

  private def distance: Double =
    Math.abs(residual(0)) + Math.abs(residual(1)) + Math.abs(residual(2))

  /** Sums stay in variables: stores to arrays take most of the time where C1 compiles. */
  private def evaluate(target: Array[Double]): Unit =
    var off0 = -target(0)
    var off1 = -target(1)
    var off2 = -target(2)
    var m0, m1, m2, m3, m4, m5, m6, m7, m8 = 0.0
    val c0 = c(0)
    val c1 = c(1)
    val c2 = c(2)
    var w = 0
    while w < count do
      val x = w.toDouble / (count - 1)
      val t = (c0 * x + c1) * x + c2
      val root = 1 / Math.sqrt(1 + t * t)
      val s = 0.5 + 0.5 * t * root
      val slope = 0.5 * root * root * root
      val r0 = responses(3 * w)
      val r1 = responses(3 * w + 1)
      val r2 = responses(3 * w + 2)
      off0 += r0 * s
      off1 += r1 * s
      off2 += r2 * s
      val d0 = r0 * slope
      val d1 = r1 * slope
      val d2 = r2 * slope
      m0 += d0 * x * x
      m1 += d0 * x
      m2 += d0
      m3 += d1 * x * x
      m4 += d1 * x
      m5 += d1
      m6 += d2 * x * x
      m7 += d2 * x
      m8 += d2
      w += 1
    residual(0) = off0
    residual(1) = off1
    residual(2) = off2
    val m = jacobian
    m(0) = m0
    m(1) = m1
    m(2) = m2
    m(3) = m3
    m(4) = m4
    m(5) = m5
    m(6) = m6
    m(7) = m7
    m(8) = m8

  /** A damped step: the system is nearly singular for the deepest colours. */
  private def step(longest: Double): Unit =
    val m = jacobian
    val a = m(4) * m(8) - m(5) * m(7)
    val b = m(5) * m(6) - m(3) * m(8)
    val d = m(3) * m(7) - m(4) * m(6)
    val det = m(0) * a + m(1) * b + m(2) * d
    if Math.abs(det) > 1e-30 then
      val s0 =
        (residual(0) * a + residual(1) * (m(2) * m(7) - m(1) * m(8)) +
          residual(2) * (m(1) * m(5) - m(2) * m(4))) / det
      val s1 =
        (residual(0) * b + residual(1) * (m(0) * m(8) - m(2) * m(6)) +
          residual(2) * (m(2) * m(3) - m(0) * m(5))) / det
      val s2 =
        (residual(0) * d + residual(1) * (m(1) * m(6) - m(0) * m(7)) +
          residual(2) * (m(0) * m(4) - m(1) * m(3))) / det
      val largest = Math.max(Math.abs(s0), Math.max(Math.abs(s1), Math.abs(s2)))
      val scale = if largest > longest then longest / largest else 1.0
      c(0) = clamp(c(0) - scale * s0)
      c(1) = clamp(c(1) - scale * s1)
      c(2) = clamp(c(2) - scale * s2)

  private def clamp(x: Double): Double = Math.max(-MaxCoefficient, Math.min(MaxCoefficient, x))

private[color] object SpectrumFit:
  private inline val Iterations = 8
  private inline val Longest = 20.0
  private inline val MaxSteps = 12
  private inline val LongestReach = 50.0

  /** Of sums of a hundred products, where Newton's method ends. */
  private inline val Rounding = 1e-10

  /** Bound of all coefficients. */
  inline val MaxCoefficient = 500.0

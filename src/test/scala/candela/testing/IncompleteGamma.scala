package candela.testing

/** The regularized incomplete gamma function, which turns a χ² statistic into a probability. */
object IncompleteGamma:

  /** Q(a, x) = Γ(a, x) / Γ(a), for a > 0 and x ≥ 0; to about 1e-10.
    *
    * Source: Press et al., "Numerical Recipes", 3rd ed., §6.2: the series for small x, the
    * continued fraction by Lentz's method for large.
    */
  def upper(a: Double, x: Double): Double =
    require(a > 0 && x >= 0, s"Q($a, $x) is not defined")
    if x == 0 then 1.0
    else if x < a + 1 then 1 - series(a, x)
    else fraction(a, x)

  private def series(a: Double, x: Double): Double =
    var term = 1 / a
    var sum = term
    var n = a
    while term > sum * 1e-16 do
      n += 1
      term *= x / n
      sum += term
    sum * Math.exp(-x + a * Math.log(x) - logGamma(a))

  private def fraction(a: Double, x: Double): Double =
    val tiny = 1e-300
    var b = x + 1 - a
    var c = 1 / tiny
    var d = 1 / b
    var h = d
    var i = 1
    var change = 0.0
    while Math.abs(change - 1) > 1e-15 && i < 100000 do
      val an = -i * (i - a)
      b += 2
      d = an * d + b
      if Math.abs(d) < tiny then d = tiny
      c = b + an / c
      if Math.abs(c) < tiny then c = tiny
      d = 1 / d
      change = d * c
      h *= change
      i += 1
    h * Math.exp(-x + a * Math.log(x) - logGamma(a))

  /** ln Γ(z) for z > 0, by recurrence to where Stirling's series is exact enough: to 1e-11. */
  def logGamma(z: Double): Double =
    var shifted = z
    var correction = 0.0
    while shifted < 12 do
      correction -= Math.log(shifted)
      shifted += 1
    val inverse = 1 / shifted
    val square = inverse * inverse
    val tail = inverse * (1.0 / 12 - square * (1.0 / 360 - square * (1.0 / 1260 - square / 1680)))
    (shifted - 0.5) * Math.log(shifted) - shifted + 0.5 * Math.log(2 * Math.PI) + tail + correction

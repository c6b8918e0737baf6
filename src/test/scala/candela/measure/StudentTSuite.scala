package candela.measure

import org.scalatest.funsuite.AnyFunSuite

class StudentTSuite extends AnyFunSuite:

  test("the chance of t is that of the tables"):
    // Two-sided points of 1 % and 5 %: Abramowitz and Stegun, table 26.10, of four digits
    for
      (freedom, one, five) <- Seq(
        (1, 63.657, 12.706),
        (2, 9.925, 4.303),
        (3, 5.841, 3.182),
        (10, 3.169, 2.228),
        (30, 2.750, 2.042),
        (120, 2.617, 1.980)
      )
    do
      assert(Math.abs(StudentT.twoSided(one, freedom) - 0.01) < 2e-5, freedom)
      assert(Math.abs(StudentT.twoSided(five, freedom) - 0.05) < 5e-5, freedom)

  test("with one degree of freedom it is Cauchy's, with two a closed form"):
    for t <- Seq(1e-3, 0.5, 1.0, 3.0, 40.0, 1e4) do
      val cauchy = 2 * Math.atan(1 / t) / Math.PI
      assert(Math.abs(StudentT.twoSided(t, 1) / cauchy - 1) < 1e-9, t)
    for t <- Seq(1e-3, 0.5, 1.0, 3.0) do
      val two = 1 - t / Math.sqrt(2 + t * t)
      assert(Math.abs(StudentT.twoSided(t, 2) / two - 1) < 1e-9, t)

  test("with many degrees of freedom it is the normal distribution's"):
    // Abramowitz and Stegun, table 26.1
    for freedom <- Seq(1e8, Double.PositiveInfinity) do
      assert(Math.abs(StudentT.twoSided(1.959964, freedom) - 0.05) < 1e-7)
      assert(Math.abs(StudentT.twoSided(6, freedom) / 1.9732e-9 - 1) < 1e-3)

  test("no difference has the chance 1, and an endless one 0"):
    assert(StudentT.twoSided(0, 7) == 1 && StudentT.twoSided(Double.PositiveInfinity, 7) == 0)

  /** The chance of |t| < x by Simpson's rule over the density of Student's distribution. */
  private def inside(x: Double, degrees: Double): Double =
    def density(t: Double) = Math.pow(1 + t * t / degrees, -(degrees + 1) / 2.0)
    def integral(from: Double, to: Double): Double =
      val n = 4000
      val h = (to - from) / n
      (0 to n).map: i =>
        val weight = if i == 0 || i == n then 1 else if i % 2 == 1 then 4 else 2
        weight * density(from + i * h) * h / 3
      .sum
    // The tails of few degrees of freedom are long: t = tan makes them finite.
    def whole =
      val n = 20000
      val h = Math.PI / 2 / n
      (0 until n).map: i =>
        val a = (i + 0.5) * h
        density(Math.tan(a)) / (Math.cos(a) * Math.cos(a)) * h
      .sum
    integral(0, x) / whole

  test("95 % of the distribution are within the limit, also of degrees that are not whole"):
    for degrees <- Vector(1, 1.5, 2, 3, 7.3, 30, 500) do
      // The rule's error is below 1e-7
      assert(Math.abs(inside(StudentT.limit(degrees), degrees) - 0.95) < 1e-6, degrees)

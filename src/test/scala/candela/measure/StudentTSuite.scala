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

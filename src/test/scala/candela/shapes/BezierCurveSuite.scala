package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class BezierCurveSuite extends AnyFunSuite:

  /** By Bernstein's polynomials. */
  private def at(c: Array[Double], u: Double): Seq[Double] =
    val m = 1 - u
    val w = Seq(m * m * m, 3 * m * m * u, 3 * m * u * u, u * u * u)
    (0 until 3).map(k => (0 until 4).map(i => w(i) * c(3 * i + k)).sum)

  private def near(a: Seq[Double], b: Seq[Double], slack: Double = 1e-12): Unit =
    assert(a.lazyZip(b).forall((x, y) => Math.abs(x - y) < slack), s"$a $b"): Unit

  private def points(draws: Draws, n: Int): Array[Float] = Array.fill(3 * n)(draws.between(-1, 1))

  test("a part of a curve is that part of it"):
    val draws = Draws(1)
    for _ <- 0 until 200 do
      val c = Array.fill(12)(draws.between(-1, 1).toDouble)
      val (a, b, s) = (draws.unit().toDouble, draws.unit().toDouble, draws.unit().toDouble)
      near(at(BezierCurve.subcurve(c, a, b), s), at(c, a + s * (b - a)), 1e-12)

  test("Bézier chains pass through the ends of their parts; degree 2 keeps its shape"):
    val draws = Draws(2)
    val p = points(draws, 7)
    def point(i: Int) = (0 until 3).map(k => p(3 * i + k).toDouble)
    val cubic = BezierCurve.ofBezier(p, 3)
    assert(cubic.size == 2)
    near(at(cubic(0), 1), point(3))
    near(at(cubic(1), 0), point(3))
    val square = BezierCurve.ofBezier(p, 2)
    assert(square.size == 3)
    for i <- 0 until 3; u <- Seq(0.0, 0.3, 0.8, 1.0) do
      val w = Seq((1 - u) * (1 - u), 2 * u * (1 - u), u * u)
      val expected = (0 until 3).map(k => (0 until 3).map(j => w(j) * point(2 * i + j)(k)).sum)
      near(at(square(i), u), expected)

  test("B-splines are what the basis of uniform knots makes of their points"):
    val draws = Draws(3)
    for degree <- Seq(2, 3) do
      val n = 8
      val p = points(draws, n)
      val knots = KnotVector(n, degree + 1, Array.tabulate(n + degree + 1)(_.toDouble))
      val curves = BezierCurve.ofBSpline(p, degree)
      assert(curves.size == n - degree)
      for (c, i) <- curves.zipWithIndex; u <- Seq(0.01, 0.4, 0.99) do
        val t = degree + i + u
        val (w, first) = (knots.weights(t)._1, knots.first(t))
        val expected =
          (0 until 3).map(k => w.indices.map(j => w(j) * p(3 * (first + j) + k)).sum)
        near(at(c, u), expected)

package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

class SphericalRectangleSuite extends AnyFunSuite:
  /** x0, x1, y0, y1, z */
  private val rectangles = Seq(
    (-1.0, 1.0, -1.0, 1.0, 1.0), // a face of a cube
    (0.5, 3.0, -0.2, 0.4, -0.7),
    (-5.0, 9.0, -7.0, 4.0, 0.05), // almost the half-space
    (0.5, 2.5, 1.0, 3.0, 1.0),
    (0.0, 1.0, 0.0, 2.0, 1.5)
  )

  private def set(r: (Double, Double, Double, Double, Double)): SphericalRectangle =
    val made = SphericalRectangle()
    made.set(r._1, r._2, r._3, r._4, r._5)
    made

  private def solidAngle(r: (Double, Double, Double, Double, Double)): Double =
    SphericalRectangle.solidAngle(r._1, r._2, r._3, r._4, r._5)

  test("a face of a cube is a sixth of the sphere"):
    assert(Math.abs(solidAngle(rectangles.head) - 4 * Math.PI / 6) < 1e-14)

  test("the solid angle is that of its two triangles, with and without the means to sample it"):
    for r <- rectangles do
      val (x0, x1, y0, y1, z) = r
      def corner(x: Double, y: Double) = Vec3(x.toFloat, y.toFloat, z.toFloat)
      val Seq(a, b, c, d) =
        Seq(corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)): @unchecked
      val two = SphericalTriangle.solidAngle(Vec3.Zero, a, b, c) +
        SphericalTriangle.solidAngle(Vec3.Zero, a, c, d)
      assert(Math.abs(solidAngle(r) / two - 1) < 1e-6, s"$r") // Float corners
      assert(SphericalRectangle().set(x0, x1, y0, y1, z) == solidAngle(r))

  test("parts of the rectangle get as many samples as they have of its solid angle"):
    val count = 20000
    for (r, seed) <- rectangles.zipWithIndex do
      val (x0, x1, y0, y1, z) = r
      val draws = Draws(seed)
      val rectangle = set(r)
      val points = Vector.fill(count):
        rectangle.sample(draws.unit(), draws.unit())
        (rectangle.x, rectangle.y)
      for s <- Seq(0.25, 0.5, 1.0); t <- Seq(0.3, 0.8) do
        val (x, y) = (x0 + s * (x1 - x0), y0 + t * (y1 - y0))
        val share = solidAngle((x0, x, y0, y, z)) / solidAngle(r)
        val found = points.count(p => p._1 < x && p._2 < y) / count.toDouble
        // Five standard deviations
        val allowed = 5 * Math.sqrt(share * (1 - share) / count)
        assert(Math.abs(found - share) < allowed, s"$r $s $t: $found, not $share")

  test("samples are points of the rectangle, whatever the numbers"):
    val draws = Draws(5)
    for r <- rectangles; i <- 0 to 16; j <- 0 to 16 do
      val rectangle = set(r)
      rectangle.sample(Math.min(i / 16f, OneMinusEpsilon), Math.min(j / 16f, OneMinusEpsilon))
      assert(rectangle.x >= r._1 && rectangle.x <= r._2, s"$r")
      assert(rectangle.y >= r._3 && rectangle.y <= r._4, s"$r")
      rectangle.sample(draws.unit(), draws.unit())
      assert(rectangle.x >= r._1 && rectangle.x <= r._2 && rectangle.y >= r._3, s"$r"): Unit

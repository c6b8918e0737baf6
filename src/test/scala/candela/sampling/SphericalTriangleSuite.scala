package candela.sampling

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.math.*
import candela.testing.ChiSquare

class SphericalTriangleSuite extends AnyFunSuite:
  private val eye = Vec3(0.3f, -0.2f, 0.1f)
  private val triangles = Seq(
    (Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)),
    (Vec3(2, -1, 1), Vec3(1, 3, 1), Vec3(-2, -1, 1.5f)),
    (Vec3(4, 4, -0.1f), Vec3(-4, 4, 0), Vec3(0, -4, 0.2f)), // almost the half-space
    (Vec3(5, 0, 0), Vec3(5, 0.01f, 3), Vec3(5, 0.02f, 3)) // a sliver
  ).map((a, b, c) => (a + eye, b + eye, c + eye))

  private def set(t: (Vec3, Vec3, Vec3)): SphericalTriangle =
    val triangle = SphericalTriangle()
    triangle.set(eye, t._1, t._2, t._3)
    triangle

  private def solidAngle(t: (Vec3, Vec3, Vec3)): Double =
    SphericalTriangle().set(eye, t._1, t._2, t._3)

  /** Möller–Trumbore without the comparisons: the weights of b and c where the ray meets the
    * plane, and its distance.
    */
  private def meet(t: (Vec3, Vec3, Vec3), w: Vec3): (Float, Float, Float) =
    val (e1, e2) = (t._2 - t._1, t._3 - t._1)
    val p = w cross e2
    val s = eye - t._1
    val inv = 1 / (e1 dot p)
    val q = s cross e1
    ((s dot p) * inv, (w dot q) * inv, (e2 dot q) * inv)

  test("an octant has a solid angle of π/2"):
    val octant = SphericalTriangle()
    val angle = octant.set(Vec3.Zero, Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 0.5f))
    assert(Math.abs(angle - Math.PI / 2) < 1e-15)

  test("a small far triangle has the solid angle area · cos / distance²"):
    val t = (eye + Vec3(0, 0, 1e3f), eye + Vec3(0, 1, 1e3f), eye + Vec3(1, 0, 1e3f))
    // positions of 1000 round to 6e-5 of the triangle's size
    assert(Math.abs(solidAngle(t) / 0.5e-6 - 1) < 2e-4)

  test("samples are as dense as the pdf says", Slow):
    for (t, i) <- triangles.zipWithIndex.take(3) do
      val triangle = set(t)
      val result = ChiSquare.directions(i + 1)(
        u => Some(triangle.sample(u(), u())),
        w =>
          val (b1, b2, distance) = meet(t, w)
          val isMet = distance > 0 && b1 >= 0 && b2 >= 0 && b1 + b2 <= 1
          if isMet then (1 / solidAngle(t)).toFloat else 0
      )
      assert(result.accepted(tests = 3), s"$t: $result")

  test("samples are unit directions that meet the triangle"):
    for t <- triangles do
      val triangle = set(t)
      for i <- 0 to 16; j <- 0 to 16 do
        val (u1, u2) = (Math.min(i / 16f, OneMinusEpsilon), Math.min(j / 16f, OneMinusEpsilon))
        val w = triangle.sample(u1, u2)
        assert(abs(w.length - 1) < 2e-7f) // rounding of three components
        val (b1, b2, _) = meet(t, w)
        // the sliver is 0.01 wide at a distance of 5, where directions round to 3e-7
        assert(b1 > -1e-3f && b2 > -1e-3f && b1 + b2 < 1.001f, s"$t ($i, $j): $b1 $b2")

  test("the solid angle is the same with and without the means to sample it"):
    for t <- triangles do
      val alone = SphericalTriangle.solidAngle(eye, t._1, t._2, t._3)
      // both are a dozen roundings of numbers up to 4 away from the truth
      assert(Math.abs(alone - solidAngle(t)) < 1e-14, s"$t")

  test("degenerate triangles have no solid angle, or half of the sphere"):
    val (a, b) = (Vec3(1, 0, 0), Vec3(0, 1, 0))
    def seen(from: Vec3, c: Vec3, b: Vec3 = b) = SphericalTriangle.solidAngle(from, a, b, c)
    assert(seen(Vec3.Zero, Vec3(-1, -1, 0)) == 2 * Math.PI, "the eye in the plane, inside")
    assert(seen(Vec3(3, 3, 0), Vec3(-1, -1, 0)) == 0, "edge-on")
    assert(seen(Vec3.Zero, Vec3(0, 0, 1), a) == 0, "two equal corners")
    assert(seen(Vec3.Zero, Vec3(0.5f, 0.5f, 0)) == 0, "corners in a line")
    assert(seen(a, Vec3(0, 0, 1)) == 0, "the eye at a corner")

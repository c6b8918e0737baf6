package candela.geometry

import org.scalatest.funsuite.AnyFunSuite

import candela.math.Vec3
import candela.testing.Draws

/** Origins of rays that leave a surface. */
class ShadingPointSuite extends AnyFunSuite:

  test("an offset point is moved along the normal, and one Float further"):
    val odd = Array(
      0f,
      -0f,
      1f,
      -1f,
      1e-45f,
      -1e-45f,
      Float.MaxValue,
      -Float.MaxValue,
      Float.PositiveInfinity,
      Float.NegativeInfinity,
      Float.NaN
    )
    val draws = Draws(7)
    def number = if draws.coin() then odd(draws.below(odd.length)) else draws.between(-2f, 2f)
    def expected(x: Float, by: Float): Float =
      val moved = x + by
      if by > 0f then Math.nextUp(moved) else if by < 0f then Math.nextDown(moved) else moved
    for i <- 0 until 10000 do
      val (x, by) = (number, number)
      // Along the x axis, by the whole error bound
      val moved = ShadingPoint.offset(Vec3(x, 0f, 0f), Vec3(by, 0f, 0f), Vec3.X, Vec3.X).x
      val expectedX = expected(x, by)
      assert(
        moved == expectedX || (moved.isNaN && expectedX.isNaN),
        s"try $i: $x by $by gave $moved instead of $expectedX"
      )

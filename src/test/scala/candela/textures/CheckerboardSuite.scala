package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class CheckerboardSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  private def at(u: Float, v: Float): ShadingPoint =
    val point = ShadingPoint()
    point.u = u
    point.v = v
    point.p = Vec3(u, v, 0.5f)
    point

  private def sign(x: Double): Double = if Math.floor(x).toLong % 2 == 0 then 1.0 else -1.0

  test("squares and cubes alternate, on the negative side too"):
    val squares = Squares(UvMapping(2f, 2f, 0f, 0f), CheckFilter.Point)
    val cubes = Cubes(Mapping3D(Transform.scale(2, 2, 1).get), CheckFilter.Point)
    for checks <- Seq(squares, cubes); i <- -6 to 6; j <- -6 to 6 do
      val p = at(i / 2f + 0.25f, j / 2f + 0.25f)
      val wanted = if (i + j) % 2 == 0 then 1f else 0f
      val number = CheckerboardFloat(checks, ConstantFloat(1f), ConstantFloat(0f))(p)
      val color = CheckerboardRgb(checks, ConstantRgb(Rgb.White), ConstantRgb(Rgb.Black))(p)
      assert(number == wanted && color == Rgb.gray(wanted), s"$i $j")

  // The midpoint rule errs by less than a step at each of the edges that it crosses
  private val steps = 20000
  private val tolerance = 2e-3

  private def mean(x: Float, width: Double)(weight: Double => Double): Double =
    val parts = (0 until steps).map(i => (i + 0.5) / steps * 2 - 1)
    parts.map(t => weight(t) * sign(x + t * width)).sum / parts.map(weight).sum

  private val places = Gen.choose(-50f, 50f)
  private val radii = Gen.oneOf(Gen.choose(1e-3f, 1f), Gen.choose(1e-6f, 1e-3f))

  test("a box averages signs, and sees nothing of more than two checks"):
    forAll(places, radii): (x: Float, r: Float) =>
      val found = CheckFilter.Box.sign(x, r)
      assert(Math.abs(found - mean(x, r)(_ => 1.0)) < tolerance, s"$x $r")
    assert(CheckFilter.Box.sign(0.3f, 1.01f) == 0.0)

  test("a triangle of one and a half steps averages signs"):
    forAll(places, Gen.oneOf(radii, Gen.choose(1f, 5f))): (x: Float, r: Float) =>
      val found = CheckFilter.Triangle.sign(x, r)
      assert(Math.abs(found - mean(x, 1.5 * r)(1 - Math.abs(_))) < tolerance, s"$x $r")

  test("without a footprint there is nothing to average"):
    for filter <- CheckFilter.values; x <- Seq(0.5f, 1f, -0.25f, 1e6f) do
      assert(filter.sign(x, 0f) == sign(x))

  test("far from the origin the mean keeps its digits"):
    // around an edge, whose place a Float carries exactly
    for filter <- Seq(CheckFilter.Box, CheckFilter.Triangle); x <- Seq(1e6f, 8e6f) do
      assert(Math.abs(filter.sign(x, 1e-3f)) < 1e-6)

  test("of a footprint over a corner half is odd"):
    val p = at(1f, 1f)
    p.dudx = 0.1f
    p.dvdy = 0.2f
    for filter <- Seq(CheckFilter.Box, CheckFilter.Triangle) do
      assert(Math.abs(Squares(UvMapping(1f, 1f, 0f, 0f), filter).oddShare(p) - 0.5f) < 1e-6f)
    // over one edge, half a step beyond it
    p.u = 1.05f
    p.v = 0.5f
    assert(Math.abs(Squares(
      UvMapping(1f, 1f, 0f, 0f),
      CheckFilter.Box
    ).oddShare(p) - 0.75f) < 1e-5f)

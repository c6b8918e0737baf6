package candela.sampling

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.ChiSquare

class WarpSuite extends AnyFunSuite:
  private val Tests = 6
  private val grid =
    for i <- 0 to 32; j <- 0 to 32
    yield (Math.min(i / 32f, OneMinusEpsilon), Math.min(j / 32f, OneMinusEpsilon))

  private def agrees(seed: Long)(sample: (Float, Float) => Vec3, pdf: Vec3 => Float): Assertion =
    val result = ChiSquare.directions(seed)(u => Some(sample(u(), u())), pdf)
    assert(result.accepted(Tests), result)

  test("the cosine hemisphere is as dense as its pdf"):
    agrees(1)(Warp.cosineHemisphere, w => Warp.cosineHemispherePdf(w.z))

  test("the uniform hemisphere is as dense as its pdf"):
    agrees(2)(Warp.uniformHemisphere, w => if w.z > 0 then InvTwoPi else 0)

  test("the uniform sphere is as dense as its pdf"):
    agrees(3)(Warp.uniformSphere, _ => Warp.UniformSpherePdf)

  test("a uniform cone is as dense as its pdf"):
    agrees(4)(
      Warp.uniformCone(_, _, 0.7f),
      w => if w.z > 0.3f then Warp.uniformConePdf(0.7f) else 0f
    )

  test("the concentric disk is uniform"):
    // polar coordinates that turn area into a unit square: r² and φ
    val result = ChiSquare.square(5)(
      u =>
        val p = Warp.concentricDisk(u(), u())
        val turns = Math.atan2(p.y, p.x) / (2 * Math.PI)
        val y = if turns < 0 then turns + 1 else turns
        Some(Vec3(Math.min(1f, p.x * p.x + p.y * p.y), y.toFloat, 0f))
      ,
      (_, _) => 1.0
    )
    assert(result.accepted(Tests), result)

  test("the uniform triangle is uniform"):
    // the triangle x, y ≥ 0, x + y < 1 has half the area of its square
    val result = ChiSquare.square(6)(
      u => Some(Warp.uniformTriangle(u(), u())),
      (x, y) => if x + y < 1 then 2.0 else 0.0
    )
    assert(result.accepted(Tests), result)

  test("directions have unit length, also at the corners of the square"):
    for (u, v) <- grid do
      val directions = Seq(
        Warp.cosineHemisphere(u, v),
        Warp.uniformHemisphere(u, v),
        Warp.uniformSphere(u, v),
        Warp.uniformCone(u, v, 1e-9f)
      )
      // each is a handful of Float operations
      for w <- directions do assert(abs(w.length - 1f) < 4e-7f, s"($u, $v): $w")

  test("hemispheres stay above the horizon, the disk within radius 1"):
    for (u, v) <- grid do
      assert(Warp.cosineHemisphere(u, v).z >= 0f)
      assert(Warp.uniformHemisphere(u, v).z >= 0f)
      assert(Warp.concentricDisk(u, v).length <= 1f + 2 * MachineEpsilon)

  test("a triangle's weights are not negative and sum to 1"):
    for (u, v) <- grid do
      val b = Warp.uniformTriangle(u, v)
      assert(b.x >= 0f && b.y >= 0f && b.z >= 0f, s"($u, $v): $b")
      assert(abs(b.x + b.y + b.z - 1f) <= 2 * MachineEpsilon)

  test("a narrow cone keeps its angle to Float precision"):
    val sine = 1e-4f
    val oneMinusCos = sine * sine / (1f + sqrt(1f - sine * sine))
    val edge = Warp.uniformCone(OneMinusEpsilon, 0f, oneMinusCos)
    assert(abs(edge.x / sine - 1f) < 1e-6f) // a handful of Float operations

  test("neighbours in the square are neighbours on the disk"):
    // half a side is a radius, so 2 is the mean stretch; a seam would jump by as much as 2
    for (u, v) <- grid; step <- Seq(1e-3f, -1e-3f) if u + step > 0 && u + step < 1 do
      val jump = Warp.concentricDisk(u + step, v) - Warp.concentricDisk(u, v)
      assert(jump.length < 4e-3f, s"($u, $v)")

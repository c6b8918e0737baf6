package candela.math

import org.scalatest.funsuite.AnyFunSuite

import candela.testing.Draws

class Vec3Suite extends AnyFunSuite:

  test("normalized has unit length for lengths from 1e-38 to 1e38"):
    val draws = Draws(1)
    for _ <- 0 until 100000 do
      val v = draws.direction() * draws.magnitude(1e-30, 1e30)
      val n = v.normalized
      val length = Math.sqrt(square(n.x).toDouble + square(n.y) + square(n.z))
      // each component is rounded by half an ulp at most, and so are the squares here
      assert(Math.abs(length - 1) <= 2 * MachineEpsilon, v)
      assert((n dot draws.direction()) <= 1.000001f)
      val parallel = n cross v.normalized
      assert(parallel.isZero, v)
    for size <- Seq(1e-38f, 1e38f, Float.MinPositiveValue, Float.MaxValue) do
      assert(Vec3(0f, -size, 0f).normalized == Vec3(0f, -1f, 0f))

  test("normalizing the zero vector gives NaN, not a direction"):
    assert(Vec3.Zero.normalized.x.isNaN)

  test("the cross product is perpendicular to both, also of nearly parallel vectors"):
    val draws = Draws(2)
    for _ <- 0 until 20000 do
      val a = draws.direction()
      val b = a + draws.direction() * 1e-5f
      val c = a cross b
      def along(v: Vec3) =
        c.x.toDouble * v.x + c.y.toDouble * v.y + c.z.toDouble * v.z
      // each component of c is off by an ulp of itself
      val bound = 3 * MachineEpsilon * c.length
      assert(Math.abs(along(a)) <= bound && Math.abs(along(b)) <= bound, s"$a $b")

  test("x cross y is z, and turning it round changes the sign"):
    assert((Vec3.X cross Vec3.Y) == Vec3.Z && (Vec3.Y cross Vec3.X) == -Vec3.Z)
    assert((Vec3.Y cross Vec3.Z) == Vec3.X && (Vec3.Z cross Vec3.X) == Vec3.Y)

  test("facing turns to the side of the other vector and leaves what is there"):
    val n = Vec3(0.6f, 0f, 0.8f)
    assert(n.facing(Vec3.Z) == n && n.facing(-Vec3.Z) == -n)

  test("what was computed of a mutable vector stays when that is overwritten"):
    for side <- Vector(Vec3.Z, -Vec3.Z) do
      val n = MutableVec3(0.6f, 0f, 0.8f)
      val (faces, copy) = (n.facing(side), n.toVec3)
      val expected = (Vec3(0.6f, 0f, 0.8f * side.z), Vec3(0.6f, 0f, 0.8f))
      n.set(Vec3.X)
      assert(faces == Vec3(expected._1.x * side.z, 0f, expected._1.z) && copy == expected._2)

  test("components are found by axis, and infinities are seen"):
    val v = Vec3(1f, 2f, 3f)
    assert(v(0) == 1f && v(1) == 2f && v(2) == 3f)
    assert(v.isFinite && !Vec3(0f, Float.PositiveInfinity, 0f).isFinite)
    assert(!Vec3(Float.NaN, 0f, 0f).isFinite)

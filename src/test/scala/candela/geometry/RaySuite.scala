package candela.geometry

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

class RaySuite extends AnyFunSuite:
  private val axes = Seq(Vec3.X, Vec3.Y, Vec3.Z, -Vec3.X, -Vec3.Y, -Vec3.Z)

  test("the shear turns the direction into +z, and keeps hands as they are"):
    val draws = Draws(1)
    val ray = Ray()
    for d <- axes ++ Seq.fill(10000)(draws.direction() * draws.magnitude(1e-3, 1e3)) do
      ray.set(Vec3.Zero, d, 1f)
      val along = d(ray.kz)
      assert(Seq(0, 1, 2).forall(k => abs(d(k)) <= abs(along)))
      assert(abs(d(ray.kx) + ray.shearX * along) <= MachineEpsilon * abs(along) * 2)
      assert(abs(d(ray.ky) + ray.shearY * along) <= MachineEpsilon * abs(along) * 2)
      assert(abs(along * ray.shearZ - 1f) <= MachineEpsilon * 2)
      // With z pointing forwards the order of the axes must be an even permutation, else odd
      val isEven = (ray.ky - ray.kx + 3) % 3 == 1
      assert(isEven == (along > 0f) && (ray.kx + ray.ky + ray.kz) == 3)

  test("a zero component has an infinite inverse of its sign"):
    val ray = Ray()
    ray.set(Vec3.Zero, Vec3(0f, -0f, 1f), 1f)
    assert(ray.invX == Float.PositiveInfinity && ray.invY == Float.NegativeInfinity)
    assert(ray.at(3f) == Vec3(0f, 0f, 3f))

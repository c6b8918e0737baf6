package candela.textures

import candela.geometry.ShadingPoint
import candela.math.*
import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

class MappingSuite extends AnyFunSuite:

  private def at(p: Vec3): ShadingPoint =
    val point = ShadingPoint()
    point.p = p
    point

  // Float angles and coordinates of size 1 after a Double computation.
  private def assertIs(c: TexCoord, s: Double, t: Double): Assertion =
    assert(Math.abs(c.s - s) < 1e-6 && Math.abs(c.t - t) < 1e-6, s"(${c.s}, ${c.t})")

  private val moved = Transform.translate(10, 20, 30)

  test("noise far out is that of the same place, though its Floats are those near the origin"):
    for octaves <- 1 to 6; p <- Seq(Vec3(.3f, .7f, .1f), Vec3(-.4f, 1.6f, 9.2f)) do
      // Numbers that Floats hold exactly, so that both know the same place
      val far = Position(8192, -4096, 2048)
      val near = Vec3((p.x * 64).toInt / 64f, (p.y * 64).toInt / 64f, (p.z * 64).toInt / 64f)
      val there = Vec3(near.x + 8192, near.y - 4096, near.z + 2048)
      val a = Octaves.fbm(there, 0f, .5f, octaves, Position.Origin)
      val b = Octaves.fbm(near, 0f, .5f, octaves, far)
      // Each octave's coordinates are rounded to 1/2048 of a step of its noise, whose slope is 2
      assert(Math.abs(a - b) < 1e-2, s"$octaves octaves at $p: $a, $b")

  test("uv coordinates are scaled, then moved"):
    val point = ShadingPoint()
    point.u = 0.5f
    point.v = 0.25f
    assertIs(UvMapping(2f, 4f, 0.5f, -3f)(point), 1.5, -2)

  test("each coordinate of an affine mapping is of both parameters, in the footprint, too"):
    val point = ShadingPoint()
    point.u = 0.5f
    point.v = 0.25f
    point.dudx = 1f
    point.dvdy = 1f
    val map = AffineUvMapping(2f, 4f, 0.5f, 8f, -1f, 1f)
    assertIs(map(point), 2.5, 4.75)
    val f = map.footprint(point)
    assert((f.dsdx, f.dsdy, f.dtdx, f.dtdy) == (2f, 4f, 8f, -1f))

  test("spherical: s from +z, t around z from +x"):
    val map = SphericalMapping(moved)
    assertIs(map(at(Vec3(10f, 20f, 35f))), 0, 0)
    assertIs(map(at(Vec3(12f, 20f, 30f))), 0.5, 0)
    assertIs(map(at(Vec3(10f, 23f, 30f))), 0.5, 0.25)
    assertIs(map(at(Vec3(10f, 17f, 30f))), 0.5, 0.75)
    assertIs(map(at(Vec3(10f, 20f, 29f))), 1, 0)

  test("cylindrical: s around z from −x; the height of the point or of its direction"):
    val point = at(Vec3(13f, 20f, 34f))
    assertIs(CylindricalMapping(moved, onUnitSphere = false)(point), 0.5, 4)
    assertIs(CylindricalMapping(moved, onUnitSphere = true)(point), 0.5, 0.8)
    assertIs(CylindricalMapping(moved, onUnitSphere = false)(at(Vec3(10f, 19f, 30f))), 0.25, 0)

  test("a planar mapping goes along two axes"):
    val map = PlanarMapping(moved, Vec3(0f, 2f, 0f), Vec3(1f, 0f, 1f), 0.5f, -1f)
    assertIs(map(at(Vec3(11f, 22f, 33f))), 4.5, 3)

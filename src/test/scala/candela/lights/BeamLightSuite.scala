package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.math.*
import candela.shapes.Disk
import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class BeamLightSuite extends AnyFunSuite:

  /** ∫ of the beam times the cosine over the hemisphere, by rings of equal angle. */
  private def flux(beam: Beam): Double =
    val rings = 20000
    (0 until rings).map: i =>
      val a = (i + 0.5) * Math.PI / 2 / rings
      beam(Math.cos(a).toFloat) * Math.cos(a) * Math.sin(a) * Math.PI / 2 / rings * 2 * Math.PI
    .sum

  for angle <- Vector(0.02, 0.049, 0.051, 0.5, 1.2, 1.5) do
    test(s"a grid of half-angle $angle keeps the power of the light"):
      // Rings of 8e-5 radians, and 0.2 % of the series for small angles
      assert(Math.abs(flux(Grid(Vec3.Z, angle)) / Math.PI - 1) < 4e-3)

  test("a grid hides all of the light beyond its angle, and all light behind"):
    val grid = Grid(Vec3.Z, 0.5)
    assert(grid(Math.cos(0.49).toFloat) > 0f && grid(Math.cos(0.51).toFloat) == 0f)
    assert(grid(-0.9f) == 0f)

  test("a cone is a smoothstep of the cosine between its edge and its inner cone"):
    val cone = Cone(Vec3.Z, 0.5f, 0.9f)
    assert(cone(0.95f) == 1f && cone(0.5f) == 0f && Math.abs(cone(0.7f) - 0.5f) < 1e-6f)
    assert(Math.abs(cone(0.6f) - (3 * 0.0625f - 2 * 0.015625f)) < 1e-6f)
    assert(Cone(Vec3.Z, 0.5f, 0.5f)(0.51f) == 1f)

  test("emitted rays carry the radiance of their direction"):
    val disk = Disk(Transform.Identity, 0f, 1f, 0f, TwoPi, false)
    val plain = AreaLight(disk, Rgb(1f, 2f, 3f), false, disk.bounds, Vec3.Z, 1f)
    val light = BeamLight(plain, Grid(Vec3.Z, 0.8))
    val (draws, out, at) = (Draws(5), EmittedRay(), ShadingPoint())
    at.geometricNormal = Vec3.Z
    for _ <- 1 to 100 do
      light.emit(
        Ball(Vec3.Zero, 1f),
        draws.unit(),
        draws.unit(),
        draws.unit(),
        draws.unit(),
        out
      )
      assert(out.radiance == light.radiance(at, out.direction))

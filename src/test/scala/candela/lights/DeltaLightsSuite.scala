package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.math.*
import candela.testing.Draws

final class DeltaLightsSuite extends AnyFunSuite:
  private val out = LightSample()

  test("a point light shines with the inverse square of the distance"):
    val light = PointLight(Vec3(1, 2, 3), Rgb(4f, 8f, 12f))
    val draws = Draws(1)
    for _ <- 1 to 1000 do
      val from = draws.vec(-5, 5)
      light.sample(from, draws.unit(), draws.unit(), out)
      val to = Vec3(1, 2, 3) - from
      assert(out.pdf == 1f && !out.isInfinite && out.target.p == Vec3(1, 2, 3))
      assert((out.wi - to.normalized).length < 1e-6f) // rounding
      assert(Math.abs(out.radiance.g * to.lengthSquared / 8f - 1f) < 1e-6f)

  test("a point light does not light its own place"):
    PointLight(Vec3.X, Rgb.White).sample(Vec3.X, 0.5f, 0.5f, out)
    assert(out.pdf == 0f)

  test("a point light matters everywhere, more nearby"):
    val bounds = PointLight(Vec3.Zero, Rgb.White).bounds.get
    val draws = Draws(2)
    for _ <- 1 to 1000 do
      val p = draws.direction() * draws.between(0.1f, 10f)
      assert(bounds.importance(p, Vec3.Zero) > 0f)
      assert(bounds.importance(p, p.normalized) > 0f)
    assert(bounds.importance(Vec3(0, 0, 1), Vec3.Zero) > bounds.importance(
      Vec3(0, 0, 2),
      Vec3.Zero
    ))

  test("a distant light comes from one direction, alike everywhere"):
    val light = DistantLight(Vec3.Y, Rgb(1f, 2f, 3f))
    for from <- Seq(Vec3.Zero, Vec3(100, -3, 7)) do
      light.sample(from, 0.1f, 0.9f, out)
      assert(out.wi == Vec3.Y && out.radiance.toRgb == Rgb(
        1f,
        2f,
        3f
      ) && out.pdf == 1f && out.isInfinite)
    assert(light.bounds.isEmpty)

  test("rays meet neither by chance"):
    assert(PointLight(Vec3.Zero, Rgb.White).isDelta && DistantLight(Vec3.Z, Rgb.White).isDelta)

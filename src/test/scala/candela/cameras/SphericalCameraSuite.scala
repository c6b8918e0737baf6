package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Ray
import candela.lights.{EqualAreaMap, LatLongMap}
import candela.math.*

final class SphericalCameraSuite extends AnyFunSuite:
  private val toWorld =
    Transform.translate(1, 2, 3) * Transform.rotate(40, 1, 2, 3).get
  private val frame = FilmFrame(64, 64)
  private val latLong = SphericalCamera(toWorld, frame, LatLongMap, folds = false)
  private val equalArea = SphericalCamera(toWorld, frame, EqualAreaMap, folds = true)

  private def direction(camera: Camera, x: Float, y: Float): Vec3 =
    val ray = Ray()
    camera.generate(x, y, 0.5f, 0.5f, ray)
    assert((ray.origin - Vec3(1, 2, 3)).length < 1e-6f)
    toWorld.inverse.vector(ray.direction)

  private def assertClose(a: Vec3, b: Vec3): Unit =
    assert((a - b).length < 1e-5f, s"$a, expected $b"): Unit

  test("longitude runs from +x over +z, colatitude from +y"):
    assertClose(direction(latLong, 0f, 32f), Vec3.X)
    assertClose(direction(latLong, 16f, 32f), Vec3.Z)
    assertClose(direction(latLong, 40f, 0f), Vec3.Y)
    assertClose(direction(latLong, 32f, 32f), -Vec3.X)

  test("the equal-area image has +y in its middle and −y in its corners"):
    assertClose(direction(equalArea, 32f, 32f), Vec3.Y)
    assertClose(direction(equalArea, 0f, 0f), -Vec3.Y)
    assertClose(direction(equalArea, 64f, 32f), Vec3.X)
    assertClose(direction(equalArea, 32f, 64f), Vec3.Z)

  /** Steradians that a cell of the image covers, by the spherical excess of two triangles. */
  private def solidAngle(camera: Camera, x: Float, y: Float, size: Float): Double =
    def triangle(a: Vec3, b: Vec3, c: Vec3) =
      2 * Math.atan2(
        Math.abs(a dot (b cross c)).toDouble,
        1.0 + (a dot b) + (b dot c) + (c dot a)
      )
    val (a, b) = (direction(camera, x, y), direction(camera, x + size, y))
    val (c, d) = (direction(camera, x, y + size), direction(camera, x + size, y + size))
    triangle(a, b, c) + triangle(b, c, d)

  test("every pixel of the equal-area image sees as much of the sphere"):
    for x <- 0 until 64; y <- 0 until 64 do
      val parts =
        for i <- 0 until 6; j <- 0 until 6
        yield solidAngle(equalArea, x + i / 6f, y + j / 6f, 1 / 6f)
      // Great circles cut corners
      assert(Math.abs(parts.sum * 64 * 64 / (4 * Math.PI) - 1) < 0.02, s"($x, $y)")

  test("a row of the equirectangular image sees as much as its height on the axis"):
    for y <- 0 until 64 do
      val found = (0 until 64).map(x => solidAngle(latLong, x.toFloat, y.toFloat, 1f)).sum
      val (top, bottom) = (Math.cos(Math.PI * y / 64), Math.cos(Math.PI * (y + 1) / 64))
      // Great circles cut corners: at a pole, by (2π / 64)² / 6 = 0.16 %
      assert(Math.abs(found / (2 * Math.PI * (top - bottom)) - 1) < 0.005)

  test("beyond a border an image goes on where the sphere does"):
    for i <- 1 until 64; (camera, size) <- Seq((latLong, 64f), (equalArea, 64f)) do
      val e = 1e-3f
      for (a, b) <- Seq(
          (direction(camera, e, i.toFloat), direction(camera, -e, i.toFloat)),
          (direction(camera, size - e, i.toFloat), direction(camera, size + e, i.toFloat)),
          (direction(camera, i.toFloat, e), direction(camera, i.toFloat, -e)),
          (direction(camera, i.toFloat, size - e), direction(camera, i.toFloat, size + e))
        )
      do assert((a - b).length < 3e-4f)

  test("differentials are as wide as pixels"):
    val (ray, scratch) = (Ray(), Ray())
    latLong.generate(20f, 30f, 0.5f, 0.5f, ray)
    latLong.differential(20f, 30f, 0.5f, 0.5f, 0.5f, ray, scratch)
    val d = ray.differential
    val wide = 2 * Math.PI / 64 * Math.sin(Math.PI * 30 / 64) / 2
    assert(Math.abs((d.xDirection - ray.direction).length - wide) < 2e-4 * wide)
    assert(Math.abs((d.yDirection - ray.direction).length - Math.PI / 128) < 2e-6)

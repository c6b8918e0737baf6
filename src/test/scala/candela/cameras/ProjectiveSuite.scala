package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Ray
import candela.math.*
import candela.testing.Draws

final class ProjectiveSuite extends AnyFunSuite:
  private val toWorld =
    Transform.lookAt(Seq(1.0, 2.0, 3.0), Seq(1.0, 2.0, 8.0), Seq(0.0, 1.0, 0.0)).get.inverse
  private val eye = Vec3(1, 2, 3)

  private def setup(lens: Float = 0f, focus: Float = 5f): ProjectiveSetup =
    ProjectiveSetup(toWorld, 200, 100, (-2f, 2f, -1f, 1f), lens, focus)

  private def ray(camera: Camera, x: Float, y: Float, u: Float = 0.5f, v: Float = 0.5f): Ray =
    val r = Ray()
    camera.generate(x, y, u, v, r)
    r

  // Rounding of a few operations on numbers below 10
  private def assertClose(a: Vec3, b: Vec3, tolerance: Float = 1e-5f): Unit =
    assert((a - b).length < tolerance, s"$a, expected $b"): Unit

  private def assertUnit(r: Ray): Unit = assert(Math.abs(r.direction.length - 1f) < 1e-6f): Unit

  test("the middle of the film looks along the axis"):
    val r = ray(PerspectiveCamera(setup(), 60f), 100f, 50f)
    assertClose(r.origin, eye)
    assertClose(r.direction, Vec3.Z)

  test("the angle from the middle to the edge of the shorter side is half the field of view"):
    val camera = PerspectiveCamera(setup(), 60f)
    val top = ray(camera, 100f, 0f).direction
    assert(top.y > 0f)
    assertClose(top, Vec3(0, sin(radians(30)), cos(radians(30))))
    assertClose(ray(camera, 100f, 100f).direction, Vec3(0, -sin(radians(30)), cos(radians(30))))

  test("a pixel is square: the longer side spans the ratio of the sides"):
    val side = ray(PerspectiveCamera(setup(), 60f), 200f, 50f).direction
    assert(Math.abs(Math.abs(side.x / side.z) - 2 * Math.tan(Math.PI / 6)) < 1e-5)

  test("corners mirror one another"):
    val camera = PerspectiveCamera(setup(), 60f)
    val (a, b) = (ray(camera, 0f, 0f).direction, ray(camera, 200f, 100f).direction)
    assertClose(Vec3(-a.x, -a.y, a.z), b)

  test("x grows to the right as seen from the eye"):
    // Left-handed camera space: right of +z with up +y is +x
    assert(ray(PerspectiveCamera(setup(), 60f), 200f, 50f).direction.x > 0f)

  test("rays through the whole lens meet in the plane of focus, where the pinhole ray does"):
    val draws = Draws(3)
    val (sharp, pinhole) =
      (PerspectiveCamera(setup(lens = 0.5f), 60f), PerspectiveCamera(setup(), 60f))
    for _ <- 1 to 200 do
      val (x, y) = (draws.between(0, 200), draws.between(0, 100))
      val through = ray(sharp, x, y, draws.unit(), draws.unit())
      val straight = ray(pinhole, x, y)
      def inFocus(r: Ray) = r.at((eye.z + 5f - r.oz) / r.dz)
      assertUnit(through)
      assert((through.origin - eye).length <= 0.5f + 1e-5f)
      assertClose(inFocus(through), inFocus(straight), 1e-4f) // a rounded direction, 8 units away

  test("the lens is used all over"):
    val camera = PerspectiveCamera(setup(lens = 0.5f), 60f)
    val draws = Draws(4)
    val offsets =
      Seq.fill(1000)(ray(camera, 20f, 20f, draws.unit(), draws.unit()).origin - eye)
    assert(offsets.exists(_.x > 0.4f) && offsets.exists(_.x < -0.4f))
    assert(offsets.exists(_.y > 0.4f) && offsets.exists(_.y < -0.4f))

  test("orthographic rays are parallel and start across the screen window"):
    val camera = OrthographicCamera(setup())
    for (x, y) <- Seq((0f, 0f), (200f, 0f), (37f, 88f)) do
      val r = ray(camera, x, y)
      assertClose(r.direction, Vec3.Z)
      assertClose(r.origin, eye + Vec3(-2 + x / 50, 1 - y / 50, 0))

  test("orthographic rays through a lens start on it and meet in the plane of focus"):
    val camera = OrthographicCamera(setup(lens = 0.3f))
    val draws = Draws(5)
    for _ <- 1 to 100 do
      val r = ray(camera, 60f, 30f, draws.unit(), draws.unit())
      assert((r.origin - eye).length <= 0.3f + 1e-5f)
      assertUnit(r)
      assertClose(r.at((eye.z + 5f - r.oz) / r.dz), eye + Vec3(-0.8f, 0.4f, 5f), 1e-4f) // as above

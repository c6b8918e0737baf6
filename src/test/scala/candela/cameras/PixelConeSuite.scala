package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Ray, ShadingPoint}
import candela.math.*

class PixelConeSuite extends AnyFunSuite:
  private val toWorld = Transform.translate(1, 2, 3) * Transform.rotate(40, 1, 2, 3).get
  private def setup(lens: Float) =
    ProjectiveSetup(toWorld, 80, 60, (-1.333f, 1.333f, -1f, 1f), lens, 5f)
  private val eye = toWorld.point(Vec3.Zero)

  /** On a plane across the camera's axis, at this distance. */
  private def facing(distance: Float): ShadingPoint =
    val at = ShadingPoint(wantsPartials = true)
    at.p = toWorld.point(Vec3(0, 0, distance))
    at.geometricNormal = toWorld.vector(Vec3(0, 0, -1))
    at

  test("a camera's differential is the distance of neighbouring pixels, with and without a lens"):
    for (camera, step) <- Seq[(Camera, Float)](
        (PerspectiveCamera(setup(0f), 60f), 5f * Math.tan(Math.PI / 6).toFloat * 2f / 60),
        (PerspectiveCamera(setup(0.3f), 60f), 5f * Math.tan(Math.PI / 6).toFloat * 2f / 60),
        (OrthographicCamera(setup(0f)), 2f / 60)
      )
    do
      val (ray, scratch) = (Ray(), Ray())
      camera.generate(40f, 30f, 0.7f, 0.4f, ray)
      camera.differential(40f, 30f, 0.7f, 0.4f, 0.25f, ray, scratch)
      val at = facing(5f)
      at.p = ray.at(5f / (ray.direction dot toWorld.vector(Vec3.Z)))
      assert(ray.differential.computeFootprint(at))
      assert(abs(at.dpdx.length - step / 4) < 2e-4f * step)
      assert(abs(at.dpdy.length - step / 4) < 2e-4f * step)
      assert(abs(at.dpdx.normalized dot at.dpdy.normalized) < 1e-3f)

  test("without a differential, the footprint is that of the sharpest pixel at the same distance"):
    val camera = PerspectiveCamera(setup(0f), 60f)
    val cone = PixelCone.of(camera, eye, 80, 60, 0.5f)
    // In the corner a pixel is cos²θ of one in the middle wide, and cos³θ in the steepest direction
    val middle = 7f * Math.tan(Math.PI / 6).toFloat * 2f / 60
    val at = facing(7f)
    cone.approximateFootprint(at)
    assert(at.dpdx.length < 0.5f * middle * 1.001f && at.dpdx.length > 0.5f * middle * 0.5f)
    assert(abs(at.dpdx dot at.geometricNormal) < 1e-5f)

  test("an orthographic camera's footprint does not grow with distance"):
    val cone = PixelCone.of(OrthographicCamera(setup(0f)), eye, 80, 60, 1f)
    for distance <- Seq(1f, 10f) do
      val at = facing(distance)
      cone.approximateFootprint(at)
      assert(abs(at.dpdx.length - 2f / 60) < 2e-5f && abs(at.dpdy.length - 2f / 60) < 2e-5f)

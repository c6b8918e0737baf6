package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.{Ball, Bounds3, ShadingPoint}
import candela.image.Image
import candela.math.*
import candela.shapes.Sphere
import candela.testing.Draws

/** Light paths start with the light that there is, where their densities say. */
final class EmittedRaySuite extends AnyFunSuite:
  private val turned = Transform.translate(0.3, -1, 2) * Draws(2).rotation()
  private val frame = LightFrame(turned)
  private val axis = Vec3(1, 2, 3).normalized
  private val scene = Ball(Vec3(1, 2, 3), 2.5f)
  private def degrees(d: Double) = Math.cos(Math.toRadians(d)).toFloat

  private def chart(width: Int, height: Int): Image =
    val draws = Draws(5)
    Image(width, height, Image.RgbNames, Array.fill(3 * width * height)(draws.unit()))

  private val globe = Sphere(turned, 0.7f, -0.7f, 0.4f, 4f, reversed = true)

  private def area(twoSided: Boolean) =
    AreaLight(globe, Rgb(1, 2, 3), twoSided, globe.bounds, Vec3.Z, -1f)

  private val sky = SphereImage(chart(16, 8), LatLongMap, Rgb(1, 2, 3), false)

  // With the green light that all directions get together: of points ∫ of the intensity
  private def intensity(light: PositionedLight): Double =
    Skies.sphere(light.intensity(_).g.toDouble)
  private val spot = SpotLight(frame, axis, Rgb(1, 2, 3), degrees(40), degrees(25), Fade.Cubic)
  private val slide =
    ProjectionLight(
      frame,
      Rgb(1, 2, 3),
      0.7f,
      Some(Picture(chart(8, 4), PictureLookup.Nearest)),
      true
    )
  private val measured = GoniometricLight(frame, sky)

  private val all: Seq[(String, Light, Double)] = Seq(
    ("point", PointLight(frame.position, Rgb(1, 2, 3)), 8 * Math.PI),
    ("spot", spot, intensity(spot)),
    ("slide", slide, intensity(slide)),
    ("goniometric", measured, intensity(measured)),
    ("distant", DistantLight(axis, Rgb(1, 2, 3)), 2.0 * scene.area),
    ("area", area(false), 2 * Math.PI * globe.area),
    ("two-sided area", area(true), 4 * Math.PI * globe.area),
    ("constant sky", ConstantEnvironment(Rgb(1, 2, 3), true), 8 * Math.PI * scene.area),
    (
      "sky",
      ImageEnvironment(frame, sky, true),
      Skies.sphere(d => sky(frame.toLight(d)).g.toDouble) * scene.area
    )
  )

  for (name, light, power) <- all do
    test(s"$name: all that sets out together is its power"):
      val (draws, out) = (Draws(7), EmittedRay())
      val count = 40000
      val sum = (1 to count).map: _ =>
        light.emit(scene, draws.unit(), draws.unit(), draws.unit(), draws.unit(), out)
        out.power.g.toDouble
      // Relative deviations are below 2, the mean's below 1 %
      assert(Math.abs(sum.sum / count / power - 1) < 0.03, s"${sum.sum / count}, expected $power")
      assert(light.power(scene) > 0f)

    test(s"$name: what it says is the density is that of its choice"):
      val (draws, out) = (Draws(8), EmittedRay())
      for _ <- 1 to 500 do
        light.emit(scene, draws.unit(), draws.unit(), draws.unit(), draws.unit(), out)
        assert(out.pdf > 0f && Math.abs(out.direction.length - 1f) < 1e-5f)
        val pdf = light.emissionPdf(scene, out.p, out.n, out.direction)
        // Near the edge of a cosine and on borders of pixels rounding decides
        assert(Math.abs(pdf / out.pdf - 1f) < 1e-3f || out.cosine < 1e-3f || name == "sky")

    test(s"$name: where light arrives, the light sampled from there has the radiance that set out"):
      val (draws, out, sample) = (Draws(9), EmittedRay(), LightSample())
      for _ <- 1 to 200 do
        light.emit(scene, draws.unit(), draws.unit(), draws.unit(), draws.unit(), out)
        val from = out.p + out.direction * 1.5f
        assert(light.connectionPdf(from, out) > 0f)
        light match
          case l: SurfaceLight =>
            val at = ShadingPoint()
            at.p = out.p
            at.geometricNormal = out.n
            assert(l.radiance(at, out.direction) == out.radiance)
            assert(l.connectionPdf(from, out) == l.pdf(from, at) * out.cosine)
          case l: EnvironmentLight =>
            assert(l.connectionPdf(from, out) == l.pdf(from, -out.direction))
          case l: PositionedLight =>
            l.sample(from, 0f, 0f, sample)
            val arrived = out.radiance * (1f / l.connectionPdf(from, out))
            assert((arrived - sample.radiance.toRgb).largest <= 0.02f * arrived.largest + 1e-4f)
          case l => assert(l.connectionPdf(from, out) == 1f)

  test("light from afar starts before the scene and covers all of it"):
    val (draws, out) = (Draws(10), EmittedRay())
    val light = DistantLight(axis, Rgb.White)
    val hits = (1 to 2000).map: _ =>
      light.emit(scene, draws.unit(), draws.unit(), 0f, 0f, out)
      val d = out.p - scene.center
      assert(Math.abs((d dot out.direction) + scene.radius) < 1e-5f)
      (d + out.direction * scene.radius).length
    assert(hits.max > 0.99f * scene.radius && hits.max <= scene.radius * 1.00001f)

  test("a scene without surfaces gets no light from afar"):
    val out = EmittedRay()
    val nowhere = Ball.enclosing(Bounds3.Empty)
    ConstantEnvironment(Rgb.White, true).emit(nowhere, 0.3f, 0.3f, 0.3f, 0.3f, out)
    assert(out.pdf == 0f && out.power.isBlack)

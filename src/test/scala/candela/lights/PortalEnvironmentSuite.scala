package candela.lights

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.color.Rgb
import candela.geometry.Frame
import candela.image.Image
import candela.math.*
import candela.testing.{ChiSquare, Draws}

final class PortalEnvironmentSuite extends AnyFunSuite:
  private val image =
    val draws = Draws(1)
    Image(16, 16, Image.RgbNames, Array.fill(768)(0.1f + 3f * pow(draws.unit(), 6f)))

  // A window of 2 × 1 at z = 1, turned away from the axes
  private val turn = Draws(7).rotation()
  private val window = Frame(turn.vector(Vec3.X), turn.vector(Vec3.Y), turn.vector(Vec3.Z))
  private def place(x: Float, y: Float, z: Float) = turn.point(Vec3(x, y, z))
  private val light = PortalEnvironment(
    LightFrame(Draws(3).rotation()),
    SphereImage(image, EqualAreaMap, Rgb(1f, 2f, 3f), smooth = false),
    place(-1f, -0.5f, 1f),
    place(1f, 0.5f, 1f),
    window
  )
  private val inside = Seq(place(0f, 0f, 0f), place(0.7f, -2f, -1f), place(-0.9f, 0.4f, 0.9f))
  private val behind = place(0.2f, 0.1f, 1.2f)

  private def isThrough(from: Vec3, d: Vec3): Boolean =
    val (o, w) = (window.toLocal(from), window.toLocal(d))
    val t = (1f - o.z) / w.z
    w.z > 0f && t > 0f && Math.abs(o.x + t * w.x) < 1f && Math.abs(o.y + t * w.y) < 0.5f

  test("light comes through the window alone, and to no point behind it"):
    val draws = Draws(4)
    for from <- inside; _ <- 1 to 5000 do
      val d = draws.direction()
      assert(light.radiance(from, d).isBlack == !isThrough(from, d), s"$from $d")
      assert(light.radiance(behind, d).isBlack && light.pdf(behind, d) == 0f)
    val out = LightSample()
    light.sample(behind, 0.3f, 0.6f, out)
    assert(out.pdf == 0f)

  test("a sample's density and radiance are those of its direction"):
    val draws = Draws(5)
    val out = LightSample()
    for from <- inside do
      val off = (1 to 3000).count: _ =>
        light.sample(from, draws.unit(), draws.unit(), out)
        assert(out.pdf > 0f && out.isInfinite && Math.abs(out.wi.length - 1f) < 1e-5f)
        out.radiance.toRgb != light.radiance(from, out.wi) ||
        Math.abs(out.pdf - light.pdf(from, out.wi)) > 1e-3f * out.pdf
      // Rounding may move a direction over one of the 16 borders between pixels, or the window's
      assert(off <= 3)

  test("directions are as dense as the pdf says, which integrates to 1", Slow):
    val out = LightSample()
    for (from, i) <- inside.zipWithIndex do
      val result = ChiSquare.directions(i + 1, draws = 100000, cosBins = 40, phiBins = 40)(
        u =>
          light.sample(from, u(), u(), out)
          Option.when(out.pdf > 0f)(out.wi)
        ,
        light.pdf(from, _)
      )
      assert(result.accepted(tests = 3), s"$from: $result")
      // The window's edge cuts about 1000 of the 262144 cells of the sum
      val sum = Skies.sphere(light.pdf(from, _).toDouble)
      assert(Math.abs(sum - 1) < 0.02, s"$from: $sum")

  test("a window onto nothing is not sampled"):
    val dark = SphereImage(Image.rgb(2, 2), EqualAreaMap, Rgb.White, smooth = false)
    val frame = LightFrame(Transform.Identity)
    assert(!PortalEnvironment(frame, dark, place(-1, -1, 1), place(1, 1, 1), window).isSampled)

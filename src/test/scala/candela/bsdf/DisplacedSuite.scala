package candela.bsdf

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.geometry.{Frame, ShadingPoint}
import candela.math.*
import candela.testing.Draws
import candela.textures.*

class DisplacedSuite extends AnyFunSuite:
  private val inner = DiffuseMaterial(ConstantRgb(Rgb.gray(0.5f)))

  /** h = a·u + b·v². */
  private final class Hill(a: Float, b: Float) extends FloatTexture:
    def apply(at: ShadingPoint): Float = a * at.u + b * at.v * at.v

  /** A plane with these tangents. */
  private def plane(dpdu: Vec3, dpdv: Vec3): ShadingPoint =
    val at = ShadingPoint(wantsPartials = true)
    at.geometricNormal = (dpdu cross dpdv).normalized
    at.frame.set(Frame.along(at.geometricNormal, dpdu))
    at.setPartials(dpdu, dpdv, Vec3.Zero, Vec3.Zero)
    at.p = Vec3(1f, 2f, 3f)
    at.u = 0.3f
    at.v = 0.7f
    at

  // Differences over 5e-4 are off by as much in slope, where v² bends: more on short tangents
  private def near(a: Vec3, b: Vec3) = assert((a - b).length < 2e-3f, s"$a instead of $b")

  test("the shading normal is that of the displaced surface"):
    val draws = Draws(1)
    for _ <- 0 until 200 do
      val at = plane(draws.vec(-2, 2), draws.vec(-2, 2))
      val (n, dpdu, dpdv) = (at.geometricNormal, at.dpdu, at.dpdv)
      // Not slivers, on which any normal is sensitive
      if (dpdu.normalized cross dpdv.normalized).length > 0.3f then
        val (a, b) = (draws.between(-1, 1), draws.between(-1, 1))
        val _ = BumpMaterial(inner, Hill(a, b), 0.0005f).bsdf(at)
        val expected = ((dpdu + n * a) cross (dpdv + n * (2 * b * 0.7f))).normalized
        near(at.frame.n, expected.facing(n))
        assert(abs(at.frame.s dot at.frame.n) < 1e-6f): Unit

  /** Knows its slopes, of which it has none. */
  private object Flat extends FloatTexture:
    def apply(at: ShadingPoint): Float = at.u
    override def slopes(at: ShadingPoint): Slopes = Slopes(0.5f, -0.25f)

  test("Mitsuba's bumps lean by the texture's own slopes, from tangents of the shading normal"):
    val draws = Draws(2)
    for _ <- 0 until 200 do
      val at = plane(draws.vec(-2, 2), draws.vec(-2, 2))
      // As on a mesh with normals
      val n = (at.geometricNormal.toVec3 + draws.vec(-0.4f, 0.4f)).normalized
      at.frame.set(Frame.along(n, at.dpdu))
      def level(v: Vec3) = v - n * (n dot v)
      val (u, v) = (level(at.dpdu), level(at.dpdv))
      val _ = SlopeBumpMaterial(inner, Flat, 0.0005f).bsdf(at)
      val expected = ((u + n * 0.5f) cross (v - n * 0.25f)).normalized
      near(at.frame.n, expected.facing(at.geometricNormal))
    val level = plane(Vec3.X, Vec3.Y)
    val _ = SlopeBumpMaterial(inner, Hill(0.5f, 0.25f), 0.0005f).bsdf(level)
    near(level.frame.n, Vec3(-0.5f, -0.35f, 1f).normalized)
    assert(level.u == 0.3f && level.v == 0.7f)

  test("the point is as it was, but for its frame"):
    val at = plane(Vec3.X, Vec3.Y)
    val _ = BumpMaterial(inner, Hill(1f, 1f), 0.01f).bsdf(at)
    assert(at.p == Vec3(1f, 2f, 3f) && at.u == 0.3f && at.v == 0.7f)
    assert(at.geometricNormal == Vec3.Z && at.dpdu == Vec3.X)

  test("bumps that sink are dents"):
    val (rising, sinking) = (plane(Vec3.X, Vec3.Y), plane(Vec3.X, Vec3.Y))
    sinking.bumpSide = -1f
    val material = BumpMaterial(inner, Hill(0.5f, 0.2f), 0.0005f)
    val _ = (material.bsdf(rising), material.bsdf(sinking))
    val (up, down) = (rising.frame.n, sinking.frame.n)
    near(Vec3(-up.x, -up.y, up.z), down)

  test("half the footprint is the step: finer waves than that are not seen"):
    object Steps extends FloatTexture:
      def apply(at: ShadingPoint): Float = Math.floor(at.u * 100.0).toFloat / 100
    val at = plane(Vec3.X, Vec3.Y)
    at.dudx = 0.4f
    at.dudy = -0.4f
    val _ = BumpMaterial(inner, Steps, 0.0005f).bsdf(at)
    // The staircase rises as fast as u: 45 degrees
    near(at.frame.n, Vec3(-1f, 0f, 1f).normalized)

  test("height in space, not over u and v, bends the normal too, whatever the tangents' length"):
    object Slope extends FloatTexture:
      def apply(at: ShadingPoint): Float = 0.5f * at.p.x
    for size <- Seq(0.5f, 1f, 4f) do
      val at = plane(Vec3.X * size, Vec3.Y * size)
      val _ = BumpMaterial(inner, Slope, 0.0005f).bsdf(at)
      near(at.frame.n, Vec3(-0.5f, 0f, 1f).normalized)

  test("a map of normals turns the frame to the picture's normal, along the tangents"):
    val blue = MipLevel(FloatTexels(1, 1, 3, Array(0.5f, 0.5f, 1f)), Wrap.Repeat)
    val tilted = MipLevel(FloatTexels(1, 1, 3, Array(0.8f, 0.5f, 0.9f)), Wrap.Repeat)
    val upright = UvMapping(1f, 1f, 0f, 0f)
    val (dpdu, dpdv) = (Vec3(0f, 2f, 0f), Vec3(0f, 0f, 3f))
    val (flat, turned) = (plane(dpdu, dpdv), plane(dpdu, dpdv))
    val _ = NormalMapMaterial(inner, blue, upright).bsdf(flat)
    val _ = NormalMapMaterial(inner, tilted, upright).bsdf(turned)
    near(flat.frame.n, Vec3.X)
    near(turned.frame.n, Vec3(0.8f, 0.6f, 0f))

  test("a map of normals may be turned on the surface; its normals still follow the tangents"):
    // Left, right: leaning along u, along v
    val leans =
      MipLevel(FloatTexels(2, 1, 3, Array(0.8f, 0.5f, 0.9f, 0.5f, 0.8f, 0.9f)), Wrap.Repeat)
    val quarter = AffineUvMapping(0f, 1f, 0f, 1f, 0f, 0f)
    def normal(mapping: Mapping2D) =
      val at = plane(Vec3.X, Vec3.Y)
      at.u = 0.25f
      at.v = 0.75f
      val _ = NormalMapMaterial(inner, leans, mapping).bsdf(at)
      at.frame.n
    near(normal(UvMapping(1f, 1f, 0f, 0f)), Vec3(0.6f, 0f, 0.8f))
    near(normal(quarter), Vec3(0f, 0.6f, 0.8f))

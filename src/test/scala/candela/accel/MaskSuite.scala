package candela.accel

import org.scalatest.funsuite.AnyFunSuite

import candela.accel.tracing.{Bvh, Grid, Hierarchies}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.shapes.{Disk, Mesh, TriangleSoup}
import candela.testing.{Draws, Soups}
import candela.textures.{ConstantFloat, FloatTexture}

class MaskSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()

  /** A hole where u is below one half. */
  private object LeftHalf extends FloatTexture:
    def apply(at: ShadingPoint): Float = if at.u < 0.5f then 0f else 0.01f

  private val whole = ConstantFloat(1f)

  /** Two triangles that make the unit square at z = 0, with u = x and v = y. */
  private def square(z: Float): Seq[Soups.Triangle] =
    Seq((Vec3(0f, 0f, z), Vec3(1f, 0f, z), Vec3(1f, 1f, z)))

  private def triangles(mask: Mask): Primitives =
    Primitives(Soups.of(square(0f)), Array.empty, Instances.Empty, Masks(Array(mask), Array.empty))

  private def down(x: Float, y: Float, from: Float = 1f): Ray =
    ray.set(Vec3(x, y, from), Vec3(0f, 0f, -1f), Float.PositiveInfinity)
    ray

  private val accelerators: Seq[(String, Primitives => Accelerator)] =
    Seq(
      "bvh" -> (Bvh(_)),
      "blocks" -> (Hierarchies.scalar(_)),
      "grid" -> (Grid(_)),
      "brute force" -> (BruteForce(_))
    )

  for (name, make) <- accelerators do
    test(s"a surface that is open behind is met from the front only: $name"):
      val world = make(triangles(FrontMask(SolidMask)))
      def up = ray.set(Vec3(0.75f, 0.25f, -1f), Vec3(0f, 0f, 1f), Float.PositiveInfinity)
      assert(world.closest(down(0.75f, 0.25f), hit) && ray.tMax == 1f)
      up
      assert(!world.closest(ray, hit))
      up
      assert(!world.isOccluded(ray, hit))

    test(s"a triangle is met where it has no hole: $name"):
      val world = make(triangles(HoleMask(LeftHalf, whole)))
      // u is x: the corners without uv are (0,0), (1,0), (1,1)
      assert(world.closest(down(0.75f, 0.25f), hit) && ray.tMax == 1f)
      assert(!world.closest(down(0.3f, 0.2f), hit) && hit.primitive == -1)
      assert(ray.tMax == Float.PositiveInfinity, "a hole leaves the ray as it is")
      assert(world.isOccluded(down(0.75f, 0.25f), hit) && ray.tMax == Float.PositiveInfinity)
      assert(!world.isOccluded(down(0.3f, 0.2f), hit))

    test(s"what is behind a hole is met, with its own parameters: $name"):
      val far = Soups.of(square(0f) ++ square(-1f))
      val half = far.count / 2
      val meshes = Array(0, half).map(Mesh(0, _, half, Array.empty, Array.empty, false, 0, -1))
      val soup = new TriangleSoup(far.positions, far.indices, meshes, tangents = true)
      val masks = Masks(Array(HoleMask(LeftHalf, whole), SolidMask), Array.empty)
      for flip <- Seq(1f, -1f) do
        val world = make(Primitives(soup, Array.empty, Instances.Empty, masks))
        ray.set(Vec3(0.3f, 0.2f, flip * 5f), Vec3(0f, 0f, -flip), Float.PositiveInfinity)
        assert(world.closest(ray, hit) && hit.primitive == 1)
        val at = ShadingPoint()
        soup.surface(1, hit, at)
        assert(Math.abs(at.u - 0.3f) < 1e-6f && Math.abs(at.p.z + 1f) < 1e-6f)

  test("columns of masks keep none while all are opaque, and each from the first on that is not"):
    val (solid, mixed) = (MaskColumn(), MaskColumn())
    solid.add(SolidMask, 1000)
    mixed.add(SolidMask, 2)
    assert(Masks.of(solid, mixed).isEmpty && Masks.of(solid, mixed).ofShape.isEmpty)
    val mask = HoleMask(ConstantFloat(0f), ConstantFloat(0f))
    mixed.add(mask, 2)
    mixed.add(SolidMask)
    val masks = Masks.of(solid, mixed)
    assert(masks.meshes == 0 && masks.shapes == 2 && masks.ofMesh.length == 1000)
    assert(masks.ofShape.toVector == Vector(SolidMask, SolidMask, mask, mask, SolidMask))

  test("holes of shadows are none for other rays"):
    val world = Bvh(triangles(HoleMask(whole, LeftHalf)))
    assert(world.closest(down(0.3f, 0.2f), hit))
    assert(!world.isOccluded(down(0.3f, 0.2f), hit))

  test("through a hole of a sphere its far side is met"):
    /** A hole in the upper half. */
    object Top extends FloatTexture:
      def apply(at: ShadingPoint): Float = if at.p.z > 0f then 0f else 1f
    val sphere = Soups.sphere(Transform.Identity, 1f)
    val masks = Masks(Array.empty, Array(HoleMask(Top, whole)))
    val world = Bvh(Primitives(Soups.Empty, Array(sphere), Instances.Empty, masks))
    assert(world.closest(down(0.1f, 0.2f, from = 3f), hit))
    assert(Math.abs(ray.at(ray.tMax).z + Math.sqrt(0.95).toFloat) < 1e-5f)
    ray.set(Vec3(-3f, 0f, 0.5f), Vec3(1f, 0f, 0f), Float.PositiveInfinity)
    assert(!world.closest(ray, hit), "both sides are holes")

  test("a veil lets through as many rays as its alpha says, and the same ones again"):
    val draws = Draws(1)
    for alpha <- Seq(0f, 0.2f, 0.7f, 1f) do
      val disk = Disk(Transform.Identity, 0f, 1f, 0f, TwoPi, false)
      val masks = Masks(Array.empty, Array(StochasticMask(ConstantFloat(alpha), separate = false)))
      val world = Bvh(Primitives(Soups.Empty, Array(disk), Instances.Empty, masks))
      val n = 20000
      var met = 0
      for _ <- 0 until n do
        val (x, y) = (draws.between(-0.5f, 0.5f), draws.between(-0.5f, 0.5f))
        val found = world.closest(down(x, y), hit)
        if found then met += 1
        assert(world.isOccluded(down(x, y), hit) == found)
      // Five standard deviations
      val bound = 5 * Math.sqrt(n * alpha * (1.0 - alpha))
      assert(Math.abs(met - n * alpha) <= bound + 1e-3, s"$met of $n at $alpha")

  /** How many of 20,000 rays meet one of two veils. */
  private def countMet(alphas: Seq[Float], separate: Boolean): Int =
    val draws = Draws(2)
    val disks = Array(0f, -0.5f).map(z => Disk(Transform.Identity, z, 1f, 0f, TwoPi, false))
    val veils = alphas.map(a => StochasticMask(ConstantFloat(a), separate))
    val masks = Masks(Array.empty, Array(veils*))
    val world =
      Bvh(Primitives(Soups.Empty, disks.map(d => d), Instances.Empty, masks))
    (0 until 20000).count: _ =>
      world.isOccluded(down(draws.between(-0.5f, 0.5f), draws.between(-0.5f, 0.5f)), hit)

  /** Within five standard deviations of a binomial count. */
  private def assertShare(met: Int, p: Double): Unit =
    assert(Math.abs(met - p * 20000) < 5 * Math.sqrt(20000 * p * (1 - p))): Unit

  test("two veils one behind the other are passed independently"):
    assertShare(countMet(Seq(0.5f, 0.5f), separate = true), 0.75)

  test("a ray that passes a veil of pbrt-v4 passes all of no higher alpha"):
    assertShare(countMet(Seq(0.5f, 0.5f), separate = false), 0.5)
    assertShare(countMet(Seq(0.3f, 0.6f), separate = false), 0.6)

  test("scenes without holes are traced through primitives that know of none"):
    val corners = triangles(SolidMask)
    assert(corners.packed(Array(0)).isInstanceOf[SolidPrimitives])
    assert(triangles(HoleMask(LeftHalf, whole)).packed(Array(0)).isInstanceOf[MaskedPrimitives])

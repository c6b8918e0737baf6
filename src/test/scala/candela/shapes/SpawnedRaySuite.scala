package candela.shapes

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.{Draws, Soups}

/** Rays that leave a surface don't meet it again where they can't. */
class SpawnedRaySuite extends AnyFunSuite:
  private val Tries = 100000
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  /** Spheres and disks of size 1e-3 to 1e4, up to 300 sizes away from the origin. */
  private def placement(draws: Draws): (Transform, Float) =
    val size = draws.magnitude(1e-3, 1e4)
    val move = draws.translation(size * draws.magnitude(1e-3, 300))
    (move * draws.rotation() * draws.stretch(), size)

  /** Aims at the shape from around it, and answers whether the hit's geometry is now in `at`. */
  private def land(draws: Draws, shape: Shape): Boolean =
    val box = shape.bounds
    val o = box.center + draws.direction() * (box.radius * draws.between(0.1f, 4f))
    val inBox = draws.vec(-0.4f, 0.4f)
    val target = box.center +
      Vec3(inBox.x * box.extent.x, inBox.y * box.extent.y, inBox.z * box.extent.z)
    ray.set(o, (target - o).normalized, Float.PositiveInfinity)
    val found = shape.intersect(ray, hit)
    if found then shape.surface(ray, hit, at)
    found

  private def leaving(d: Vec3): Ray =
    ray.set(at.offsetOrigin(d), d, Float.PositiveInfinity)
    ray

  test("a triangle is not met again, on either side"):
    val draws = Draws(1)
    val corners = new Array[Float](9)
    var spawned = 0
    while spawned < Tries do
      val size = draws.magnitude(1e-3, 1e4)
      val centre = draws.direction() * (size * draws.magnitude(1e-3, 300))
      val soup = Soups.of(Soups.randomTriangles(draws, 1, size)(centre))
      System.arraycopy(soup.positions, 0, corners, 0, 9)
      val b = draws.unit()
      hit.u = b * draws.unit()
      hit.v = b - hit.u
      soup.surface(0, hit, at)
      val d = draws.direction()
      val own = leaving(d)
      assert(!TriangleTest.isHit(corners, 0, own, hit), s"${at.p} ${at.geometricNormal} $d")
      spawned += 1

  test("a plane of many triangles across an axis is not met again", Slow):
    val draws = Draws(2)
    for _ <- 0 until 100 do
      val axis = draws.below(3)
      val size = draws.magnitude(1e-3, 1e4)
      val height = draws.between(-30, 30)
      def put(p: Vec3) =
        val q = Array(p.x * size, p.y * size, p.z * size)
        q(axis) = height * size
        Vec3(q(0), q(1), q(2))
      val soup = Soups.of(Soups.latticeQuads(draws, 20, 4)(axis).map: (a, b, c) =>
        (put(a), put(b), put(c)))
      val corners = soup.indices.slice(0, soup.indices.length).flatMap(i =>
        soup.positions.slice(3 * i, 3 * i + 3)
      )
      for _ <- 0 until Tries / 100 do
        hit.u = draws.between(0, 0.5f)
        hit.v = draws.between(0, 0.5f)
        soup.surface(draws.below(soup.count), hit, at)
        val d = draws.direction()
        val own = leaving(d)
        for i <- 0 until soup.count do
          assert(!TriangleTest.isHit(corners, 9 * i, own, hit), s"${at.p} $d")

  test("a disk is not met again, on either side"):
    val draws = Draws(3)
    var spawned = 0
    while spawned < Tries do
      val (toWorld, size) = placement(draws)
      val disk = Disk(toWorld, size * draws.between(-1, 1), size, 0f, TwoPi, draws.coin())
      if land(draws, disk) then
        val d = draws.direction()
        assert(!disk.isHit(leaving(d)), s"${at.p} ${at.geometricNormal} $d")
        spawned += 1

  test("a sphere is not met again from outside, and always from inside"):
    val draws = Draws(4)
    var spawned = 0
    while spawned < Tries do
      val (toWorld, size) = placement(draws)
      val sphere = Soups.sphere(toWorld, size)
      if land(draws, sphere) then
        val outside = draws.above(at.geometricNormal)
        assert(!sphere.isHit(leaving(outside)), s"${at.p} ${at.geometricNormal} $outside")
        assert(sphere.isHit(leaving(-outside)), s"${at.p} ${at.geometricNormal} ${-outside}")
        spawned += 1

  test("cylinders, cones and paraboloids are not met again from outside"):
    val draws = Draws(6)
    var spawned = 0
    while spawned < Tries do
      val (toWorld, size) = placement(draws)
      val shape = Quadrics.random(draws, draws.below(3), size).placed(toWorld)
      if land(draws, shape) then
        val outside = draws.above(at.geometricNormal)
        assert(!shape.isHit(leaving(outside)), s"${at.p} ${at.geometricNormal} $outside")
        spawned += 1

  test("a hyperboloid is met again only where it curves up to the ray"):
    val draws = Draws(7)
    var spawned = 0
    while spawned < Tries / 4 do
      val (toWorld, size) = placement(draws)
      val shape = Quadrics.random(draws, 3, size).placed(toWorld)
      if land(draws, shape) then
        val outside = draws.above(at.geometricNormal)
        val steep = (outside dot at.geometricNormal) > 0.1f
        // Its radii of curvature are some tenths of its size or more, stretched by 16
        val again = shape.isHit(leaving(outside)) && {
          shape.intersect(ray, hit) && ray.tMax < 1e-4f * size
        }
        assert(!steep || !again, s"${at.p} ${at.geometricNormal} $outside")
        spawned += 1

  test("points that were sampled, too, leave a sphere without meeting it"):
    val draws = Draws(5)
    val sample = SurfaceSample()
    for _ <- 0 until Tries do
      val (toWorld, size) = placement(draws)
      // Stretched ones are sampled by area, the others by the cone that is seen
      val sphere = Soups.sphere(if draws.coin() then toWorld else draws.translation(size), size)
      val from = sphere.bounds.center + draws.direction() * (size * draws.between(5, 50))
      sphere.sample(from, draws.unit(), draws.unit(), sample)
      val d = draws.above(sample.n)
      ray.set(ShadingPoint.offset(sample.p, sample.pError, sample.n, d), d, Float.PositiveInfinity)
      assert(!sphere.isHit(ray), s"${sample.p} ${sample.n} $d")

package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.Draws

class DiskSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  private def isHit(disk: Disk, o: Vec3, d: Vec3): Boolean =
    ray.set(o, d, Float.PositiveInfinity)
    val occluded = disk.isHit(ray)
    assert(disk.intersect(ray, hit) == occluded)
    occluded

  test("a ring of a quarter turn is hit where it is, and nowhere else"):
    val draws = Draws(1)
    var hits = 0
    for _ <- 0 until 50000 do
      val r = draws.magnitude(1e-2, 1e2)
      val (hole, height, sweep) =
        (r * draws.unit(), r * draws.between(-1, 1), draws.between(0.3f, 6.2f))
      val toWorld = draws.translation(3 * r) * draws.rotation() * draws.stretch()
      val disk = Disk(toWorld, height, r, hole, sweep, false)
      val (x, y) = (draws.between(-1.1f, 1.1f) * r, draws.between(-1.1f, 1.1f) * r)
      val target = toWorld.point(Vec3(x, y, height))
      val o = target + draws.direction() * (r * draws.between(0.5f, 5))
      val d = target - o
      val n = toWorld.normal(Vec3.Z).normalized
      val distance = Math.hypot(x, y)
      val phi = (Math.atan2(y, x) + 2 * Math.PI) % (2 * Math.PI)
      // The target is rounded to Float, 3 radii from the origin, and stretched by up to 4; seen at
      // more than 6° the ray comes to within 1e-4 radii of it
      val margins = Seq(distance / r - 1, (distance - hole) / r, phi - sweep, phi - TwoPi, phi)
      val clear = (n absDot d.normalized) > 0.1f && distance > 0.01 * r &&
        margins.forall(m => Math.abs(m) > 0.02)
      if clear then
        val expected = distance < r && distance > hole && phi < sweep
        assert(isHit(disk, o, d) == expected, s"$distance of $hole to $r, $phi of $sweep")
        if expected then
          hits += 1
          assert(abs(ray.tMax - 1f) < 1e-4f)
          disk.surface(ray, hit, at)
          assert((at.p - target).length < 1e-3f * r)
          assert(Math.abs(at.u - phi / sweep) < 1e-2)
          assert(Math.abs(at.v - (r - distance) / (r - hole)) < 1e-3 * r / (r - hole)): Unit
    assert(hits > 3000)

  test("hit points lie in the plane to their error bound"):
    val draws = Draws(2)
    for _ <- 0 until 50000 do
      val r = draws.magnitude(1e-2, 1e2)
      val toWorld = draws.translation(100 * r) * draws.rotation() * draws.stretch()
      val height = r * draws.between(-1, 1)
      val disk = Disk(toWorld, height, r, 0f, TwoPi, false)
      val centre = disk.bounds.center
      if isHit(disk, centre + draws.direction() * r, draws.direction()) then
        disk.surface(ray, hit, at)
        val m = toWorld.inverseM
        val z = m(8) * at.p.x + m(9) * at.p.y + m(10) * at.p.z + m(11)
        val bound = Math.abs(m(8)) * at.pError.x + Math.abs(m(9)) * at.pError.y +
          Math.abs(m(10)) * at.pError.z
        assert(Math.abs(z - height) <= bound, at.p): Unit

  test("the outside is where +z goes, mirrored too, unless reversed"):
    val draws = Draws(3)
    for _ <- 0 until 1000 do
      val toWorld = draws.translation(3) * draws.rotation() * draws.stretch()
      val up = toWorld.vector(Vec3.Z).normalized
      for reversed <- Seq(false, true) do
        val disk = Disk(toWorld, 0f, 1f, 0f, TwoPi, reversed)
        val target = toWorld.point(Vec3(0.3f, 0.2f, 0f))
        assert(isHit(disk, target + up, -up))
        disk.surface(ray, hit, at)
        assert(((at.geometricNormal dot up) > 0f) != reversed)
        assert(at.frame.n == at.geometricNormal && disk.normals._1 == at.geometricNormal)
        val along = toWorld.vector(Vec3(-0.2f, 0.3f, 0f)).normalized
        assert((at.frame.s dot along) > 0.999f, "s follows ∂p/∂u")
        // Unit vectors after a handful of operations
        assert(abs(at.frame.s dot at.frame.n) < 1e-6f)

  private val disks = Seq(
    "disk" -> Disk(Transform.Identity, 0.5f, 1f, 0f, TwoPi, false),
    "ring, stretched and mirrored" ->
      Disk(
        Transform.rotate(50, 1, 2, 3).get * Transform.scale(-2, 1, 1).get,
        0f,
        1f,
        0.5f,
        4f,
        true
      )
  )

  for ((name, disk), i) <- disks.zipWithIndex do
    test(s"samples are as dense as the pdf says: $name"):
      val see = SampledShapes.visible(disk)
      for (from, j) <- Seq(Vec3(0.3f, 0.2f, 2f), Vec3(-0.5f, 0.4f, -1f)).zipWithIndex do
        val result = SampledShapes.chiSquare(seed = 2 * i + j, disk, see, from)
        assert(result.accepted(tests = 4), s"$from $result")
        SampledShapes.pdfAgrees(disk, from, Draws(i))
        SampledShapes.integrates(disk, see, from, Draws(j))(_ => 1.0)
        SampledShapes.integrates(disk, see, from, Draws(j))(w => 1 + w.x + w.y * w.z)

  test("area and bounds are those of what is left"):
    val ring = Disk(Transform.scale(-2, 3, 1).get, 5f, 2f, 1f, 3f, false)
    assert(abs(ring.area / (0.5f * 3f * (4f - 1f) * 6f) - 1f) < 1e-6f) // a few Float operations
    // Padded by two round-offs, for points on a tilted disk that are rounded
    assert((ring.bounds.min - Vec3(-4f, -6f, 5f)).length < 2e-6f)
    assert((ring.bounds.max - Vec3(4f, 6f, 5f)).length < 2e-6f)

  test("a ray in the plane of the disk misses it"):
    val disk = Disk(Transform.Identity, 0f, 1f, 0f, TwoPi, false)
    assert(!isHit(disk, Vec3(-2f, 0f, 0f), Vec3.X) && !isHit(disk, Vec3.Zero, Vec3.Y))

  test("parameters along the radius, and their derivatives, are those of the hit point"):
    val point = ShadingPoint(wantsPartials = true)
    val toWorld = Transform.translate(1, 2, 3) * Transform.scale(2, 0.5, 1).get
    val disk = Disk(toWorld, 0f, 1f, 0f, TwoPi, false, DiskU.Radius)
    val draws = Draws(5)
    for _ <- 0 until 1000 do
      val (r, phi) = (draws.between(0.1f, 0.99f), draws.between(0.1f, 6f))
      def place(u: Float, v: Float) =
        val angle = TwoPi * (1f - v)
        toWorld.point(Vec3(u * cos(angle), u * sin(angle), 0f))
      val (u, v) = (r, 1f - phi / TwoPi)
      ray.set(place(u, v) + Vec3(0f, 0f, 2f), Vec3(0f, 0f, -1f), Float.PositiveInfinity)
      assert(disk.intersect(ray, hit))
      disk.surface(ray, hit, point)
      assert(Math.abs(point.u - u) < 1e-5f && Math.abs(point.v - v) < 1e-5f)
      // Central differences over 1/64: to 2 % of a radius
      val d = 1f / 64
      val byU = (place(u + d, v) - place(u - d, v)) * (0.5f / d)
      val byV = (place(u, v + d) - place(u, v - d)) * (0.5f / d)
      assert((point.dpdu - byU).length < 0.04f && (point.dpdv - byV).length < 0.04f)

package candela.scene

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.accel.*
import candela.accel.tracing.Bvh
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.{Draws, Soups}

/** An object that moves is at any time where it would stand if it stood still then. */
class MovingSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()

  private def affine(draws: Draws): Transform =
    draws.translation(3) * draws.rotation() * draws.stretch()

  /** Between maps of the same handedness: others are flat on the way. */
  private def motion(draws: Draws, start: Float = 0.2f, duration: Float = 0.6f): Motion =
    val (a, other) = (affine(draws), affine(draws))
    val b =
      if a.swapsHandedness == other.swapsHandedness then other
      else other * Transform.scale(1, 1, -1).get
    val between = Interpolation(a, b, start, start + duration, shortest = true)
    if draws.coin() then between else InverseMotion(between)

  private def placed(surfaces: Surfaces, motion: Motion): Instanced =
    Instanced(
      Array(surfaces),
      Instances.of(Array(Bvh(surfaces.primitives())), Vector((0, motion)).view, 0f, 1f)
    )

  test("bounds contain the surface whenever the shutter is open", Slow):
    val draws = Draws(1)
    for _ <- 0 until 60; duration <- Vector(0.6f, 0.02f) do
      val soup = Soups.of(Soups.randomTriangles(draws, 20, 1)(draws.vec(-1, 1)))
      val way = motion(draws, 0.3f, duration)
      val box = placed(Surfaces(soup, ShapeTable.Empty), way).instances.bounds(0)
      for _ <- 0 until 100 do
        val now = way.transform(draws.between(0.3f, 0.3f + duration))
        for i <- 0 until soup.count; c <- 0 until 3 do
          val p = now.point(soup.vertex(i, c))
          for k <- 0 until 3 do assert(p(k) >= box.min(k) && p(k) <= box.max(k), s"$p in $box")

  test("a shutter that is open shortly makes a small box"):
    val soup = Soups.icosphere(2, Transform.Identity)
    val far = Interpolation(
      Transform.Identity,
      Transform.translate(100, 0, 0),
      0f,
      1f,
      shortest = true
    )
    val objects = Array[Accelerator](Bvh(Primitives(soup, Array.empty)))
    val short = Instances.of(objects, Vector((0, far)).view, 0.5f, 0.51f)
    assert(Math.abs(short.bounds(0).extent.x - 3f) < 1e-4f)

  test("it is met where it is at the ray's time, and its hit points lie there"):
    val draws = Draws(2)
    val soup = Soups.of(Soups.randomTriangles(draws, 30, 0.6f)(draws.vec(-1, 1)))
    val surfaces = Surfaces(soup, ShapeTable.Empty)
    val (at, there) = (ShadingPoint(), ShadingPoint())
    val (other, otherHit) = (Ray(), Hit())
    var hits = 0
    for _ <- 0 until 100 do
      val way = motion(draws)
      val moving = placed(surfaces, way)
      for _ <- 0 until 20 do
        val time = draws.unit()
        val now = way.transform(time)
        val still = placed(surfaces, Still(now))
        val (o, target) = (now.point(draws.direction() * 3f), now.point(draws.vec(-1, 1)))
        ray.time = time
        ray.set(o, target - o, Float.PositiveInfinity)
        other.set(o, target - o, Float.PositiveInfinity)
        if moving.instances.intersect(0, ray, hit) &&
          still.instances.intersect(0, other, otherHit) && hit.inner == otherHit.inner
        then
          hits += 1
          moving.fill(0, ray, hit, at)
          still.fill(0, other, otherHit, there)
          val size = Math.max((at.p - Vec3.Zero).length, (target - o).length)
          // Roundings of Floats, stretched by up to 16, and more where the ray grazes
          assert((at.p - there.p).length < 1e-4f * size)
          assert((at.geometricNormal - there.geometricNormal).length < 1e-2f): Unit
    assert(hits > 500, s"$hits hits")

  test("a ray that leaves a moving triangle does not meet it again", Slow):
    val draws = Draws(3)
    val at = ShadingPoint()
    var spawned = 0
    while spawned < 10000 do
      val soup = Soups.of(Soups.randomTriangles(draws, 1, 1)(draws.vec(-3, 3)))
      val moving = placed(Surfaces(soup, ShapeTable.Empty), motion(draws))
      val box = moving.instances.bounds(0)
      for _ <- 0 until 30 do
        ray.time = draws.unit()
        val o = box.center + draws.direction() * (box.radius * draws.between(1f, 4f))
        val v = draws.vec(-0.4f, 0.4f)
        val target = box.center + Vec3(v.x * box.extent.x, v.y * box.extent.y, v.z * box.extent.z)
        ray.set(o, (target - o).normalized, Float.PositiveInfinity)
        if moving.instances.intersect(0, ray, hit) then
          moving.fill(0, ray, hit, at)
          val d = draws.direction()
          ray.set(at.offsetOrigin(d), d, Float.PositiveInfinity)
          assert(!moving.instances.isHit(0, ray, hit), s"${at.p} $d")
          spawned += 1

  test("instances that stand still are numbered before those that move"):
    val soup = Soups.icosphere(1, Transform.Identity)
    val objects = Array[Accelerator](Bvh(Primitives(soup, Array.empty)))
    val way = Interpolation(
      Transform.Identity,
      Transform.translate(9, 0, 0),
      0f,
      1f,
      shortest = true
    )
    val instances = Instances.of(objects, Vector((0, way), (0, Still(Transform.Identity))).view)
    assert(instances.count == 2 && instances.moving == 1)
    assert(instances.bounds(0).extent.x < 3f && instances.bounds(1).extent.x > 10f)
    val world = Bvh(Primitives(Soups.Empty, Array.empty, instances))
    ray.set(Vec3(9f, 0f, 5f), Vec3(0f, 0f, -1f), Float.PositiveInfinity)
    ray.time = 0f
    assert(!world.isOccluded(ray, hit))
    ray.time = 1f
    assert(world.isOccluded(ray, hit))

package candela.scene

import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import candela.accel.*
import candela.accel.tracing.Bvh
import candela.build.ObjectSizes
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.shapes.{Disk, Shape}
import candela.testing.{Draws, Soups}

/** An object that stands elsewhere looks as if its surfaces had been built there. */
class InstancedSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  private def placed(surfaces: Surfaces, toWorld: Transform): Instanced =
    val primitives = Primitives(surfaces.soup, surfaces.solids.groups)
    Instanced(
      Array(surfaces),
      Instances.of(Array(Bvh(primitives)), Vector((0, Still(toWorld))).view)
    )

  private def solid(shape: Shape): Surfaces =
    Surfaces(Soups.Empty, ShapeTable.of(Array(shape)))

  private def placement(draws: Draws): Transform =
    val size = draws.magnitude(1e-2, 1e3)
    draws.translation(size * draws.magnitude(1e-1, 100)) * draws.rotation() * draws.stretch() *
      Transform.scale(size, size, size).get

  private def apart(a: Vec3, b: Vec3): Float = (a - b).length

  test("a mesh is hit where its copy would be, with the same normals, tangent and parameters"):
    val draws = Draws(1)
    val facets = Soups.randomTriangles(draws, 30, 0.5f)(draws.vec(-1, 1))
    val (other, otherHit) = (Ray(), Hit())
    val there = ShadingPoint()
    var hits = 0
    for _ <- 0 until 40 do
      val toWorld = placement(draws)
      def moved(p: Vec3) = toWorld.point(p)
      val copy =
        Soups.of(facets.map((a, b, c) => (moved(a), moved(b), moved(c))), toWorld.swapsHandedness)
      val instanced = placed(Surfaces(Soups.of(facets), ShapeTable.Empty), toWorld)
      val size = copy.positions.map(Math.abs).max
      for _ <- 0 until 200 do
        val target = moved(draws.vec(-1, 1))
        val o = moved(draws.direction() * 3f)
        ray.set(o, target - o, Float.PositiveInfinity)
        other.set(o, target - o, Float.PositiveInfinity)
        if instanced.instances.intersect(0, ray, hit) && BruteForce(Primitives(copy, Array.empty))
            .closest(other, otherHit) && hit.inner == otherHit.primitive
        then
          hits += 1
          val before = hit.primitive
          instanced.fill(0, ray, hit, at)
          assert(hit.primitive == before, "an instance's hit leaves the world's alone")
          copy.surface(otherHit.primitive, otherHit, there)
          // The rounding of a ray's origin, 1e-7 of the size, grows with the slant of a facet
          assert(apart(at.p, there.p) <= 3e-5f * size)
          assert(apart(at.geometricNormal, there.geometricNormal) < 1e-2f)
          assert(apart(at.frame.n, there.frame.n) < 1e-2f)
          assert(apart(at.frame.s, there.frame.s) < 3e-2f)
          assert(abs(at.u - there.u) < 1e-2f && abs(at.v - there.v) < 1e-2f): Unit
    assert(hits > 1000, s"$hits hits")

  /** Aims at the instance from around it; is there a hit, whose geometry is now in `at`? */
  private def land(draws: Draws, instanced: Instanced): Boolean =
    val box = instanced.instances.bounds(0)
    val o = box.center + draws.direction() * (box.radius * draws.between(1f, 4f))
    val v = draws.vec(-0.4f, 0.4f)
    val target = box.center + Vec3(v.x * box.extent.x, v.y * box.extent.y, v.z * box.extent.z)
    ray.set(o, (target - o).normalized, Float.PositiveInfinity)
    val found = instanced.instances.intersect(0, ray, hit)
    if found then instanced.fill(0, ray, hit, at)
    found

  private def leaving(d: Vec3): Ray =
    ray.set(at.offsetOrigin(d), d, Float.PositiveInfinity)
    ray

  private def neverMetAgain(seed: Int)(make: Draws => Surfaces)(direction: Draws => Vec3): Unit =
    val draws = Draws(seed)
    var spawned = 0
    while spawned < 20000 do
      val instanced = placed(make(draws), placement(draws))
      for _ <- 0 until 10 do
        if land(draws, instanced) then
          val d = direction(draws)
          assert(!instanced.instances.isHit(0, leaving(d), hit), s"${at.p} ${at.pError} $d")
          spawned += 1

  test("a triangle of an instance is not met again, on either side"):
    neverMetAgain(2)(draws =>
      Surfaces(Soups.of(Soups.randomTriangles(draws, 1, 1)(draws.vec(-3, 3))), ShapeTable.Empty)
    )(_.direction())

  test("a disk of an instance is not met again, on either side"):
    neverMetAgain(3)(draws =>
      val toObject = draws.translation(3) * draws.rotation() * draws.stretch()
      solid(Disk(toObject, draws.between(-1, 1), 1f, 0f, TwoPi, draws.coin()))
    )(_.direction())

  test("a sphere of an instance is not met again from outside"):
    neverMetAgain(4)(draws =>
      solid(Soups.sphere(draws.translation(3) * draws.rotation() * draws.stretch(), 1f))
    )(_.above(at.geometricNormal))

  test("an instance's outside is its object's, also where the map mirrors"):
    val mirror = Transform.scale(-1, 1, 1).get
    for (toWorld, reversed) <- Seq((Transform.Identity, false), (mirror, false), (mirror, true)) do
      val instanced = placed(solid(Soups.sphere(Transform.Identity, 1f, reversed)), toWorld)
      ray.set(Vec3(3f, 0.2f, 0.1f), Vec3(-1f, 0f, 0f), Float.PositiveInfinity)
      assert(instanced.instances.intersect(0, ray, hit))
      instanced.fill(0, ray, hit, at)
      assert(((at.geometricNormal dot at.p) < 0f) == reversed)

  test("ten thousand instances need less than 108 bytes each"):
    val mesh = Surfaces(Soups.icosphere(5, Transform.Identity), ShapeTable.Empty)
    val objects = Array[Accelerator](Bvh(Primitives(mesh.soup, Array.empty)))
    val draws = Draws(5)
    val places = Vector.fill(10000)((0, Still(placement(draws))))
    val instances = Instances.of(objects, places.view)
    val sizes = ObjectSizes()
    sizes.add(objects): Unit
    val bytes = sizes.add(Vector(instances))
    assert(bytes < 108L * places.length + 10000, s"$bytes bytes")
    assert(instances.count == places.length)

  test("instances whose matrices are in rows already take less than 5 bytes each"):
    val mesh = Surfaces(Soups.icosphere(1, Transform.Identity), ShapeTable.Empty)
    val objects = Array[Accelerator](Bvh(Primitives(mesh.soup, Array.empty)))
    val draws = Draws(5)
    val rows = MotionRows()
    val places = Vector.fill(10000)((0, MotionRow(rows, rows.add(placement(draws)))))
    val instances = Instances.of(objects, places.view)
    val sizes = ObjectSizes()
    sizes.add(rows +: objects): Unit
    val bytes = sizes.add(Vector(instances))
    assert(bytes < 5L * places.length + 2000, s"$bytes bytes")
    // In another order, and written for themselves
    val picked = Vector.tabulate(300)(i => places(33 * i + 7))
    val shared = Instances.of(objects, picked.view)
    val copied = Instances.of(objects, picked.map((o, m) => (o, Still(m.transform(0f)))).view)
    val stranger = (0, Still(Transform.Identity))
    val mixed = Instances.of(objects, picked.updated(9, stranger).view)
    val others = sizes.add(Vector(Instances.of(objects, places.updated(9, stranger).view)))
    assert(others < 9L * places.length + 35000, s"$others bytes")
    assert(rows.count == places.length)
    for i <- picked.indices do
      assert(shared.bounds(i) == instances.bounds(33 * i + 7))
      assert(i == 9 || mixed.bounds(i) == shared.bounds(i))
      // The inverse of `copied` is not that of the row to the last bit
      assert((shared.bounds(i).min - copied.bounds(i).min).length < 1e-4f)
    assert((mixed.bounds(9).min - objects(0).bounds.min).length < 1e-5f)

  test("instances are the same, however their places are divided; moving ones are last"):
    val objects = Array[Accelerator](
      Bvh(Primitives(Soups.icosphere(1, Transform.Identity), Array.empty)),
      Bvh(Primitives(Soups.icosphere(1, Transform.scale(2, 3, 1).get), Array.empty))
    )
    val draws = Draws(6)
    val (rows, others) = (MotionRows(), MotionRows())
    val places = Vector.tabulate(20_000): i =>
      val there = draws.translation(9)
      val away = there * Transform.translate(1, 0, 0)
      val motion =
        if i % 7 < 3 then Interpolation(there, away, 0f, 1f, shortest = true)
        else if i % 3 == 0 then Still(there)
        else
          val those = if i % 3 == 1 then rows else others
          MotionRow(those, those.add(there))
      (i % 2, motion)
    val divided = new Parallel:
      def threads = 3
      def worksAside = false
      def aside(name: String)(task: => Unit): Unit = ()
      def forEach(count: Int)(task: Int => Unit): Unit = (0 until count).reverse.foreach(task)
    val alone = Instances.of(objects, places.view)
    val together = Instances.of(objects, places.view, parallel = divided)
    val (moving, still) = places.partition(_._2.moves)
    assert(alone.count == places.length)
    assert(alone.moving == moving.length && together.moving == moving.length)
    val expected = still ++ moving
    for i <- expected.indices by 9 do
      val each = Instances.of(objects, Vector(expected(i)).view).bounds(0)
      assert(alone.bounds(i) == each && together.bounds(i) == each)

  test("an instance that is drawn out until no row holds it is hit, and moves not"):
    val draws = Draws(7)
    val turn = draws.rotation()
    val needle = turn * Transform.scale(1, 1e12, 1).get * draws.rotation()
    assert(!MotionRows.canHold(needle))
    val objects =
      Array[Accelerator](Bvh(Primitives(Soups.icosphere(2, Transform.Identity), Array.empty)))
    val places = Vector((0, Still(needle)), (0, Still(Transform.translate(0, 0, 9))))
    val instances = Instances.of(objects, places.view)
    assert(instances.count == 2 && instances.moving == 0)
    // The one without a row is last
    val across = turn.vector(Vec3(1f, 0f, 0f))
    ray.set(across * 3f, -across, Float.PositiveInfinity)
    assert(!instances.intersect(0, ray, hit))
    assert(instances.intersect(1, ray, hit) && Math.abs(ray.tMax - 2f) < 0.2f)

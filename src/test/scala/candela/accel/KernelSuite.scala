package candela.accel

import org.scalatest.funsuite.AnyFunSuite

import candela.base.Parallel
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.testing.{Draws, Soups}

/** All kernels find the very hits that testing everything finds, bit by bit. */
class KernelSuite extends AnyFunSuite:

  private val hasVectors = Hierarchies.hasVectors

  private val kernels: Seq[(String, Primitives => Accelerator)] =
    Seq[(String, Primitives => Accelerator)](
      "binary" -> (Bvh(_)),
      "scalar, 4 lanes" -> (Hierarchies.scalar(_)),
      "scalar, 16 lanes" -> (Hierarchies.scalar(_, width = 16)),
      "careful" -> (Hierarchies.careful(_))
    ) ++ Option.when(hasVectors)("vector" -> (Hierarchies.vector(_, patience = 0)))

  /** Sets of triangles: each hard in its own way. */
  private def soups(draws: Draws): Seq[(String, Primitives)] =
    def anywhere = draws.vec(-1, 1)
    def of(triangles: Seq[Soups.Triangle]) = Primitives(Soups.of(triangles), Array.empty)
    def sliver(length: Float, width: Float) =
      val (a, d) = (anywhere, draws.direction() * length)
      (a, a + d, a + d * draws.unit() + draws.direction() * width)
    val far = Vec3(3e4f, -5e3f, 1e4f)
    val flat = Soups.latticeQuads(draws, 200, 6)(draws.below(3))
    Seq(
      "slivers" -> of(Seq.fill(300)(sliver(2f, draws.magnitude(1e-7, 1e-2)))),
      "needles in one direction" -> of(Seq.fill(200):
        val a = anywhere
        (a, a + Vec3(3f, 0f, 0f), a + Vec3(1.5f, 1e-6f, draws.between(-1e-7f, 1e-7f)))),
      "parallel to the axes" -> of(flat),
      "parallel to the axes, far away" -> of(flat.map((a, b, c) => (a + far, b + far, c + far))),
      "parallel to the axes, edges' products overflow" ->
        of(flat.map((a, b, c) => (a * 1e12f, b * 1e12f, c * 1e12f))),
      "the same ones again and again" -> of(Seq.fill(4)(flat.take(60)).flatten),
      "edges and corners in common" -> Primitives(
        Soups.icosphere(3, Transform.translate(0.3f, 7f, -2f)),
        Array.empty
      ),
      "points and lines" -> of(Seq.fill(100):
        val (a, b) = (anywhere, anywhere)
        if draws.coin() then (a, a, a) else (a, b, a * 0.5f + b * 0.5f)),
      "of all sizes" -> of(Seq.fill(300):
        val size = draws.magnitude(1e-6, 1e4)
        val c = anywhere * draws.magnitude(1e-3, 1e3)
        (c + draws.vec(-size, size), c + draws.vec(-size, size), c + draws.vec(-size, size))),
      "beyond the squares of Floats" -> of(Soups.around(draws, 50, 3e24f)(anywhere * 1e25f)),
      "tiny" -> of(Soups.around(draws, 50, 3e-18f)(anywhere * 1e-17f)),
      "one" -> of(Soups.around(draws, 1, 1f)(Vec3.Zero))
    ) ++ AcceleratorScenes.all.filter(s => s._2.shapes.isEmpty && s._2.instances.count == 0)

  private val odd =
    Array(
      0f, -0f, 1f, -1f, Float.NaN, Float.PositiveInfinity, Float.NegativeInfinity, 1e-42f, 1e38f
    )

  private def target(draws: Draws, primitives: Primitives): Vec3 =
    val i = draws.below(primitives.soup.count)
    val Seq(a, b, c) = Seq(0, 1, 2).map(primitives.soup.vertex(i, _)): @unchecked
    draws.below(4) match
      case 0 => a
      case 1 => a * 0.5f + c * 0.5f
      case 2 =>
        val t = draws.unit()
        a * t + b * (1f - t)
      case _ =>
        val (t, u) = (draws.unit(), 0.5f * draws.unit())
        a * (t * (1f - u)) + b * ((1f - t) * (1f - u)) + c * u

  private def aim(draws: Draws, primitives: Primitives, size: Float, middle: Vec3, ray: Ray): Unit =
    def somewhere = middle + draws.vec(-size, size) * 1.5f
    val o = if draws.coin() then somewhere else target(draws, primitives)
    val to = target(draws, primitives) - o
    val end = if draws.coin() then Float.PositiveInfinity else draws.between(0f, 1.5f)
    def keep(x: Float) = if draws.below(3) == 0 then (if draws.coin() then 0f else -0f) else x
    def strange(x: Float) = if draws.below(3) == 0 then odd(draws.below(odd.length)) else x
    draws.below(8) match
      case 0 | 1 | 2 => ray.set(o, to, end)
      case 3 => ray.set(o, to.normalized, end * to.length)
      case 4 => ray.set(o, Vec3(keep(to.x), keep(to.y), keep(to.z)), end)
      case 5 => // along an edge's plane
        val t = target(draws, primitives)
        ray.set(Vec3(t.x, o.y, o.z), Vec3(0f, to.y, to.z), end)
      case 6 =>
        val away = draws.direction() * (size * draws.magnitude(1.0, 1e6))
        ray.set(o + away, target(draws, primitives) - (o + away), Float.PositiveInfinity)
      case _ =>
        ray.set(
          Vec3(strange(o.x), strange(o.y), strange(o.z)),
          Vec3(strange(to.x), strange(to.y), strange(to.z)),
          strange(end)
        )

  private val scenes = soups(Draws(11)).filter(_._2.count > 0)

  for (name, make) <- kernels do
    test(s"hits are the same, bit by bit: $name"):
      for (scene, primitives) <- scenes do
        val reference = BruteForce(primitives)
        val kernel = make(primitives)
        val box = reference.bounds
        val size = Math.max(Math.max(box.extent.x, box.extent.y), Math.max(box.extent.z, 1e-20f))
        val middle = box.min * 0.5f + box.max * 0.5f
        val draws = Draws(scene.hashCode)
        val (ray, hit, expectedRay, expected) = (Ray(), Hit(), Ray(), Hit())
        var hits = 0
        for i <- 0 until (if primitives.count > 1000 then 300 else 3000) do
          aim(draws, primitives, size, middle, ray)
          // The plain twin keeps to rays without strange numbers
          if name != "binary" || WideKernel.isTame(ray) then
            val end = ray.tMax
            expectedRay.set(ray.origin, ray.direction, end)
            def at = s"$scene, ray $i from ${ray.origin} along ${ray.direction} to $end"
            val found = kernel.closest(ray, hit)
            assert(reference.closest(expectedRay, expected) == found, at)
            if found then
              hits += 1
              assert(hit.primitive == expected.primitive, s"$at: ${ray.tMax}, ${expectedRay.tMax}")
              val isSame =
                ray.tMax == expectedRay.tMax && hit.u == expected.u && hit.v == expected.v
              assert(isSame, at): Unit
            ray.set(expectedRay.origin, expectedRay.direction, end)
            assert(kernel.isOccluded(ray, hit) == found, at): Unit
        val tooFew = if name == "binary" && scene.startsWith("beyond") then 0 else 20
        assert(hits > tooFew, s"$scene: too few hits to tell")

  test("shadow rays that end or begin within some Floats of a triangle, or pass its edges"):
    if hasVectors then
      for (scene, primitives) <- scenes do
        val (kernel, reference) = (Hierarchies.vector(primitives, 0), BruteForce(primitives))
        val draws = Draws(scene.length)
        val (ray, hit) = (Ray(), Hit())
        def agree(o: Vec3, d: Vec3, end: Float): Unit =
          ray.set(o, d, end)
          val expected = reference.isOccluded(ray, hit)
          ray.set(o, d, end)
          assert(kernel.isOccluded(ray, hit) == expected, s"$scene: $o along $d to $end"): Unit
        for _ <- 0 until (if primitives.count > 1000 then 30 else 200) do
          val to = target(draws, primitives)
          val away = draws.direction() * draws.magnitude(1e-4, 1e4)
          val o = to + away
          val d = if draws.coin() then to - o else (to - o).normalized
          ray.set(o, d, Float.PositiveInfinity)
          if reference.closest(ray, hit) then
            val t = ray.tMax
            for ulps <- -3 to 3 do
              val near = java.lang.Float.intBitsToFloat(
                java.lang.Float.floatToRawIntBits(t) + ulps * (1 << draws.below(6))
              )
              agree(o, d, near)
              agree(o + d * near, d, Float.PositiveInfinity)
              agree(o + d * near, -d, near)

  test("a ray changes to vectors after some walks, and finds the same"):
    if hasVectors then
      val (_, primitives) = scenes.head
      val (patient, reference) = (Hierarchies.vector(primitives, 100), BruteForce(primitives))
      val draws = Draws(5)
      val (ray, hit) = (Ray(), Hit())
      for _ <- 0 until 300 do
        val (o, d) = (draws.vec(-2, 2), draws.direction())
        ray.set(o, d, Float.PositiveInfinity)
        val found = patient.closest(ray, hit)
        val (primitive, t) = (hit.primitive, ray.tMax)
        ray.set(o, d, Float.PositiveInfinity)
        assert(reference.closest(ray, hit) == found && hit.primitive == primitive)
        assert(ray.tMax == t)
      assert(ray.walks == 100 || WarmUp.closest.isOver): Unit

  test("a tree is deep enough for no stack to overflow"):
    for (scene, primitives) <- scenes; (width, lanes) <- Seq((4, 4), (8, 8), (16, 8), (16, 16)) do
      val size = LeafSize(4, lanes, primitives.isSolidTriangle)
      val built = BvhBuilder.of(primitives, size, Parallel.Alone)
      val wide = WideBuilder(width, lanes, built, primitives.isSolidTriangle, Parallel.Alone)
      assert(wide.stackNeed <= Ray.StackSize, scene)
      val owners = wide.owners.filter(_ >= 0)
      assert(owners.sorted.sameElements(Array.range(0, primitives.count)), scene)

  test("blocks of a mesh's triangles are nearly full"):
    val mesh = Primitives(Soups.icosphere(4, Transform.translate(0f, 0f, 0f)), Array.empty)
    for lanes <- Seq(4, 8) do
      val tree = WideTree.of(mesh, 16, lanes, 4, Parallel.Alone)
      val full = mesh.count.toDouble / (tree.blockCount * lanes)
      assert(full > 0.75 && full <= 1.0, s"$lanes lanes")

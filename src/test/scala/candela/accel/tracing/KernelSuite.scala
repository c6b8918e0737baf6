package candela.accel.tracing

import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import candela.accel.{Accelerator, AcceleratorScenes, BruteForce, Primitives}
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.testing.Draws

/** All kernels find the very hits that testing everything finds, bit by bit. */
class KernelSuite extends AnyFunSuite:
  import KernelSuite.*

  private val hasVectors = Hierarchies.hasVectors

  private val kernels: Seq[(String, Primitives => Accelerator)] =
    Seq[(String, Primitives => Accelerator)](
      "binary" -> (Bvh(_)),
      "scalar, 4 lanes" -> (Hierarchies.scalar(_)),
      "scalar, 16 lanes" -> (Hierarchies.scalar(_, width = 16)),
      "careful" -> (Hierarchies.careful(_))
    ) ++ Option.when(hasVectors)("vector" -> (Hierarchies.vector(_, atOnce = true)))

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

  private val scenes = AcceleratorScenes.triangles.filter(_._2.count > 0)

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
          if name != "binary" || WideKernel.isRangeSafe(ray) then
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
        val (kernel, reference) =
          (Hierarchies.vector(primitives, atOnce = true), BruteForce(primitives))
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

  test("rays change to vectors when these are compiled, and find the same"):
    if hasVectors then
      val (_, primitives) = scenes.head
      val warmUps = WarmUps()
      val later = Later()
      val (warming, reference) = (
        Hierarchies.vector(primitives, parallel = later, warmUps = warmUps),
        BruteForce(primitives)
      )
      val draws = Draws(5)
      val (ray, hit) = (Ray(), Hit())
      def agree(): Unit =
        for _ <- 0 until 300 do
          val (o, d) = (draws.vec(-2, 2), draws.direction())
          ray.set(o, d, Float.PositiveInfinity)
          val found = warming.closest(ray, hit)
          val (primitive, t) = (hit.primitive, ray.tMax)
          ray.set(o, d, Float.PositiveInfinity)
          assert(reference.closest(ray, hit) == found && hit.primitive == primitive)
          assert(ray.tMax == t)
      agree()
      later.run()
      assume(warmUps.areOver, "scalar code remains faster here")
      agree()

object KernelSuite:

  /** One thread, in which the work aside is done when a test says so. */
  private final class Later extends Parallel:
    private var waiting = Vector.empty[() => Unit]
    def threads: Int = 1
    def forEach(count: Int)(task: Int => Unit): Unit = Parallel.Alone.forEach(count)(task)
    def worksAside: Boolean = true
    def aside(name: String)(task: => Unit): Unit = waiting :+= (() => task)
    def run(): Unit = waiting.foreach(_())

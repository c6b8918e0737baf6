package candela.accel.tracing

import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}

class WarmUpSuite extends AnyFunSuite:
  import WarmUp.{Batch, TestRays}

  private def random = SplittableRandom(1)
  private val tree = WarmUp.testTree(random, 4, 4)

  private object Fast extends WideKernel:
    def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean = false
    def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean = false
    def name: String = "fast"

  /** A clock that each query advances; `times` is the time of the nth query by `Fast`. */
  private final class Clock(times: Int => Long):
    private var now = 0L
    private var queries = 0
    val warmUp: WarmUp = WarmUp(
      (kernel, _, _, _) =>
        if kernel eq Fast then
          now += times(queries)
          queries += 1
        else now += 100
        true
      ,
      () => now
    )
    def attempt(): Long = warmUp.attempt(tree, Fast, TestRays(random))

  test("a kernel is taken when most rays of a batch were faster"):
    val clock = Clock(i => if i < Batch + 4 then 101L else 99L)
    clock.attempt(): Unit
    assert(!clock.warmUp.isOver)
    clock.attempt(): Unit
    assert(clock.warmUp.isOver)

  test("a kernel of equal speed is not taken"):
    val clock = Clock(_ => 100L)
    clock.attempt(): Unit
    assert(!clock.warmUp.isOver)

  test("one long interruption of the other kernel decides nothing"):
    var scalar = 0
    var now = 0L
    val warmUp = WarmUp(
      (kernel, _, _, _) =>
        if kernel eq Fast then now += 10000
        else
          now += (if scalar == 3 then 100000000L else 100L)
          scalar += 1
        true
      ,
      () => now
    )
    warmUp.attempt(tree, Fast, TestRays(random)): Unit
    assert(!warmUp.isOver)

  test("an attempt returns the time of both kernels"):
    assert(Clock(_ => 400L).attempt() == Batch * 500L)

  test("both kernels trace the same rays: misses, triangles, their edges and corners, spheres"):
    val rays = TestRays(random)
    var misses, triangles, spheres, edges, segments = 0
    for _ <- 0 until 2000 do
      rays.advance()
      val (end, d) = (rays.ray.tMax, rays.ray.direction)
      val found = ScalarKernel.closest(tree, rays.ray, rays.hit)
      if !found then misses += 1
      else if rays.hit.primitive >= 500 then spheres += 1
      else
        triangles += 1
        val (u, v) = (rays.hit.u, rays.hit.v)
        if u.abs < 1e-6 || v.abs < 1e-6 || (1 - u - v).abs < 1e-6 then edges += 1
      if !end.isInfinite then segments += 1
      rays.again()
      assert(rays.ray.tMax == end && rays.ray.direction == d && rays.hit.primitive == -1)
    for (what, n) <- Seq(misses, triangles, spheres, edges, segments).zipWithIndex do
      assert(what > 20, s"${Seq("misses", "triangles", "spheres", "edges", "segments")(n)}"): Unit

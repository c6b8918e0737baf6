package candela.bench

import java.lang.management.ManagementFactory
import java.util.function.ToLongFunction

import candela.accel.{Accelerator, Bvh, Hierarchies, Primitives}
import candela.geometry.{Hit, Ray}

/** One kernel among those that take turns in [[RayTurns]], in a class loader of its own. Asked by
  * three Ints (set of rays, first, end) it answers how many nanoseconds of processor time these
  * took; by one how many rays are in that set; by none what `sum` was, as a Double's bits.
  */
final class RayTurn(kernel: String, triangles: java.lang.Integer, side: java.lang.Integer)
    extends ToLongFunction[Array[Int]]:
  private val soup = RayMesh(triangles)
  private val world: Accelerator =
    val primitives = RayMesh.primitives(soup)
    kernel match
      case "vector" => Hierarchies.vector(primitives, patience = 0)
      case "scalar4" => Hierarchies.scalar(primitives)
      case "scalar8" => Hierarchies.scalar(primitives, width = 8)
      case "binary" => Bvh(primitives)
  private val sets = RaySet.all(soup, world, side)
  private val ray = Ray()
  private val hit = Hit()
  private val beans = ManagementFactory.getThreadMXBean

  /** Of all that was asked for since it was last set to 0: what all kernels must agree on. */
  private var sum = 0.0

  def applyAsLong(asked: Array[Int]): Long =
    if asked.length == 1 then sets(asked(0)).count
    else if asked.length == 0 then
      val bits = java.lang.Double.doubleToLongBits(sum)
      sum = 0.0
      bits
    else
      val set = sets(asked(0))
      val from = beans.getCurrentThreadCpuTime
      if set.anyHit then occluded(set.floats, 7 * asked(1), 7 * asked(2))
      else closest(set.floats, 7 * asked(1), 7 * asked(2))
      beans.getCurrentThreadCpuTime - from

  private def occluded(f: Array[Float], from: Int, end: Int): Unit =
    var i = from
    while i < end do
      ray.set(f(i), f(i + 1), f(i + 2), f(i + 3), f(i + 4), f(i + 5), f(i + 6))
      if world.isOccluded(ray, hit) then sum += 1.0
      i += 7

  private def closest(f: Array[Float], from: Int, end: Int): Unit =
    var i = from
    while i < end do
      ray.set(f(i), f(i + 1), f(i + 2), f(i + 3), f(i + 4), f(i + 5), f(i + 6))
      if world.closest(ray, hit) then sum += ray.tMax
      i += 7

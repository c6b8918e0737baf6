package candela.bench

import java.lang.management.ManagementFactory
import java.util.function.ToLongFunction

import candela.accel.Accelerator

/** One kernel among those that take turns in [[RayTurns]], in a class loader of its own. Asked by
  * three Ints (set of rays, first, end) it answers how many nanoseconds of processor time these
  * took; by one how many rays are in that set; by none, as a Double's bits, the sum of what was
  * met since
  * it was last asked for: what all kernels must agree on.
  */
final class RayTurn(kernel: String, triangles: java.lang.Integer, side: java.lang.Integer)
    extends ToLongFunction[Array[Int]]:
  private val soup = RayMesh(triangles)
  private val world: Accelerator =
    RayKernels.kernels(RayMesh.primitives(soup)).find(_._1 == kernel).map(_._2()).getOrElse:
      throw IllegalArgumentException(s"no kernel $kernel")
  private val sets = RaySet.all(soup, world, side)
  private val passes = sets.map(RayPass(world, _))
  private val beans = ManagementFactory.getThreadMXBean

  def applyAsLong(asked: Array[Int]): Long =
    if asked.length == 1 then sets(asked(0)).count
    else if asked.length == 0 then
      // Hits without a distance count as 1
      val all = passes.zip(sets).map((p, set) => if set.anyHit then p.hits.toDouble else p.sum).sum
      passes.foreach(_.clear())
      java.lang.Double.doubleToLongBits(all)
    else
      val from = beans.getCurrentThreadCpuTime
      passes(asked(0)).run(asked(1), asked(2))
      beans.getCurrentThreadCpuTime - from

package candela.accel

import candela.base.loop
import candela.geometry.{Bounds3, Hit, Ray}

/** Acceleration structure over a set of primitives. Immutable; the traversal's scratch memory is in
  * the ray.
  */
abstract class Accelerator:

  /** Finds the closest hit in (0, `ray.tMax`): shortens the ray and fills `hit`. Sets
    * `hit.primitive` to −1 if the ray misses.
    */
  def closest(ray: Ray, hit: Hit): Boolean

  /** Whether anything is hit in (0, `ray.tMax`). `hit` is scratch memory. */
  def isOccluded(ray: Ray, hit: Hit): Boolean

  def bounds: Bounds3

  /** Kind and size, for the render plan. */
  def describe: String

/** Tests every primitive: the oracle for tests and benchmarks of the other accelerators. */
final class BruteForce(primitives: Primitives) extends Accelerator:
  private val packed = primitives.packed(Array.range(0, primitives.count))

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    packed.intersect(0, primitives.count, ray, hit)

  def isOccluded(ray: Ray, hit: Hit): Boolean = packed.isHit(0, primitives.count, ray, hit)

  val bounds: Bounds3 = Accelerator.union(primitives.bounds)
  def describe: String = s"none: ${primitives.count} primitives tested in turn"

object Accelerator:
  /** Union of boxes of six Floats each. */
  def union(bounds: Array[Float]): Bounds3 =
    import candela.math.Vec3
    val box = Array.fill(6)(Float.PositiveInfinity)
    java.util.Arrays.fill(box, 3, 6, Float.NegativeInfinity)
    loop(bounds.length / 6): i =>
      loop(3): k =>
        box(k) = Math.min(box(k), bounds(6 * i + k))
        box(3 + k) = Math.max(box(3 + k), bounds(6 * i + 3 + k))
    Bounds3(Vec3(box(0), box(1), box(2)), Vec3(box(3), box(4), box(5)))

package candela.accel

import candela.base.loop
import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** Objects that stand in many places without being copied: each place is a pair of matrices, and a
  * ray that comes to it goes on in the object's space, among the object's own primitives.
  *
  * The direction keeps its length on the way there, whatever the matrix makes of it; so a distance
  * means the same in both spaces. The matrices are applied in Double: all that is lost is the
  * rounding of the object-space ray to Float, which [[Placement.locate]] adds to the error of a hit
  * point.
  *
  * Source of the idea: Sutherland, "Sketchpad", 1963; for rays: Rubin and Whitted, "A 3-dimensional
  * Representation for Fast Rendering of Complex Scenes", SIGGRAPH 1980.
  *
  * @param objects  what there is to be placed
  * @param objectOf index into `objects` of each instance
  * @param matrices 24 Doubles an instance, as [[Placement]] has them
  */
final class Instances(
    objects: Array[Accelerator],
    val objectOf: Array[Int],
    matrices: Array[Double]
):
  def count: Int = objectOf.length

  def bounds(i: Int): Bounds3 =
    Placement.bounds(matrices, i * Placement.Doubles, objects(objectOf(i)).bounds)

  /** The closest hit of instance `i` in (0, `ray.tMax`): shortens the ray, and writes which
    * primitive of the object it was to `hit.inner`; `hit.primitive` stays as it is.
    */
  def intersect(i: Int, ray: Ray, hit: Hit): Boolean =
    val local = enter(i, ray)
    val before = hit.primitive
    val found = objects(objectOf(i)).closest(local, hit)
    if found then
      ray.tMax = local.tMax
      hit.inner = hit.primitive
    hit.primitive = before
    found

  def isHit(i: Int, ray: Ray, hit: Hit): Boolean =
    objects(objectOf(i)).isOccluded(enter(i, ray), hit)

  /** The ray in the space of the object: it lies in `ray.nested`. */
  def enter(i: Int, ray: Ray): Ray = Placement.enter(matrices, i * Placement.Doubles, ray)

  /** Takes a shading point on instance `i` from the object's space to the world. */
  def locate(i: Int, at: ShadingPoint): Unit =
    Placement.locate(matrices, i * Placement.Doubles, at)

object Instances:
  val None: Instances = Instances(Array.empty, Array.empty, Array.empty)

  /** @param places (index into `objects`, object to world) */
  def of(objects: Array[Accelerator], places: IndexedSeq[(Int, Transform)]): Instances =
    val matrices = new Array[Double](places.length * Placement.Doubles)
    val objectOf = new Array[Int](places.length)
    loop(places.length): i =>
      objectOf(i) = places(i)._1
      Placement.write(places(i)._2, matrices, i * Placement.Doubles)
    Instances(objects, objectOf, matrices)

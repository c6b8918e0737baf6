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
  * @param matrices those of the first instances, which stand still: 24 Doubles each, as
  *                 [[candela.math.Motion]] writes them
  * @param motions  of the instances after those
  * @param open     when the shutter opens, and when it closes
  */
final class Instances private (
    objects: Array[Accelerator],
    val objectOf: Array[Int],
    matrices: Array[Double],
    motions: Array[Motion],
    open: Float,
    close: Float
):
  private val still = matrices.length / Motion.Doubles

  def count: Int = objectOf.length
  def moving: Int = motions.length

  def bounds(i: Int): Bounds3 =
    val box = objects(objectOf(i)).bounds
    if i < still then Placement.bounds(matrices, i * Motion.Doubles, box)
    else Placement.bounds(motions(i - still), open, close, box)

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
  def enter(i: Int, ray: Ray): Ray =
    if i < still then Placement.enter(matrices, i * Motion.Doubles, ray)
    else
      val space = ray.nested.space
      motions(i - still).write(ray.time, space, 0)
      Placement.enter(space, 0, ray)

  /** Takes a shading point on instance `i` from the object's space to the world; the ray is the one
    * that has just been asked to [[enter]] it.
    */
  def locate(i: Int, ray: Ray, at: ShadingPoint): Unit =
    if i < still then Placement.locate(matrices, i * Motion.Doubles, at)
    else Placement.locate(ray.nested.space, 0, at)

object Instances:
  val Empty: Instances = of(Array.empty, Vector.empty)

  /** @param places      (index into `objects`, object to world); those that move are numbered last
    * @param open, close when the shutter is open
    */
  def of(
      objects: Array[Accelerator],
      places: IndexedSeq[(Int, Motion)],
      open: Float = 0f,
      close: Float = 1f
  ): Instances =
    val moving = places.count(_._2.moves)
    val still = places.length - moving
    val matrices = new Array[Double](still * Motion.Doubles)
    val motions = new Array[Motion](moving)
    val objectOf = new Array[Int](places.length)
    var atRest = 0
    var underWay = 0
    loop(places.length): i =>
      val which = places(i)._1
      val motion = places(i)._2
      if motion.moves then
        objectOf(still + underWay) = which
        motions(underWay) = motion
        underWay += 1
      else
        objectOf(atRest) = which
        motion.write(0f, matrices, atRest * Motion.Doubles)
        atRest += 1
    new Instances(objects, objectOf, matrices, motions, open, close)

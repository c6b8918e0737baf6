package candela.accel

import candela.base.{IntBuffer, loop}
import candela.concurrency.Parallel
import scala.collection.IndexedSeqView

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** Object instances: an instance is a matrix, by which a ray that enters it is transformed to
  * object space, and traced against the object's own accelerator. The matrix back is computed from
  * it where a hit is looked at.
  *
  * The transformed direction is not normalised, so distances mean the same in both spaces. Matrices
  * are applied in Double: the only loss is the rounding of the object-space ray to Float, which
  * [[Placement.locate]] adds to the error of a hit point.
  *
  * Source of the idea: Sutherland, "Sketchpad", 1963; for rays: Rubin and Whitted, "A 3-dimensional
  * Representation for Fast Rendering of Complex Scenes", SIGGRAPH 1980.
  *
  * @param objects  accelerators of the objects
  * @param objectOf index into `objects` of each instance
  * @param matrices of the static instances, which come first; see [[candela.math.MotionRows]]
  * @param rowOf    number of the matrix of each; null: its own
  * @param motions  motions of the animated instances, which follow, and of those that have no row
  * @param moving   how many are animated
  * @param open     shutter opening time; `close` is its closing time
  */
final class Instances private (
    objects: Array[Accelerator],
    val objectOf: Array[Int],
    matrices: Array[Array[Double]],
    rowOf: Array[Int] | Null,
    motions: Array[Motion],
    val moving: Int,
    open: Float,
    close: Float
):
  private val staticCount = objectOf.length - motions.length

  def count: Int = objectOf.length

  def bounds(i: Int): Bounds3 =
    val box = objects(objectOf(i)).bounds
    if i < staticCount then Placement.bounds(written(i, new Array[Double](Motion.Doubles)), 0, box)
    else Placement.bounds(motions(i - staticCount), open, close, box)

  /** Finds the closest hit of instance `i` in (0, `ray.tMax`): shortens the ray and writes the
    * object's primitive to `hit.inner`; leaves `hit.primitive` unchanged.
    */
  def intersect(i: Int, ray: Ray, hit: Hit): Boolean =
    val local = enter(i, ray)
    val previousPrimitive = hit.primitive
    val hasHit = objects(objectOf(i)).closest(local, hit)
    if hasHit then
      ray.tMax = local.tMax
      hit.inner = hit.primitive
    hit.primitive = previousPrimitive
    hasHit

  def isHit(i: Int, ray: Ray, hit: Hit): Boolean =
    objects(objectOf(i)).isOccluded(enter(i, ray), hit)

  /** Transforms the ray to object space; the result is `ray.nested`. */
  def enter(i: Int, ray: Ray): Ray =
    if i < staticCount then Placement.enter(numbers(i), start(i), ray)
    else
      val space = ray.nested.space
      motions(i - staticCount).write(ray.time, space, 0)
      Placement.enter(space, Placement.Inverse, ray)

  /** Transforms a shading point on instance `i` from object to world space, for the ray last passed
    * to [[enter]] for it.
    */
  def locate(i: Int, ray: Ray, at: ShadingPoint): Unit =
    val space = ray.nested.space
    Placement.locate(if i < staticCount then written(i, space) else space, 0, at)

  /** The object's point `p`, in world space at the ray's time. */
  def toWorld(i: Int, ray: Ray, p: Vec3): Vec3 = Placement.point(rows(i, ray), 0, p)

  /** The point `p` of world space, in the object's at the ray's time. */
  def toObject(i: Int, ray: Ray, p: Vec3): Vec3 =
    Placement.point(rows(i, ray), Placement.Inverse, p)

  /** Area in the object's space per area in world space, at the ray's time, of a surface that has
    * the unit normal `n` in world space.
    */
  def shrinkage(i: Int, ray: Ray, n: Vec3): Float = Placement.shrinkage(rows(i, ray), 0, n)

  /** Mean scale of lengths, of the moving ones when the shutter opens. */
  def stretch(i: Int): Double =
    val m = new Array[Double](Motion.Work)
    if i < staticCount then written(i, m): Unit else motions(i - staticCount).write(open, m, 0)
    Math.cbrt(Math.abs(Placement.determinant(m, 0)))

  private def row(i: Int): Int =
    val rows = rowOf
    if rows == null then i else rows(i)

  /** Of a static instance. */
  private def numbers(i: Int): Array[Double] = matrices(MotionRows.chunk(row(i)))

  private def start(i: Int): Int = MotionRows.start(row(i))

  /** Both matrices of a static instance, written to `to`. */
  private def written(i: Int, to: Array[Double]): Array[Double] =
    MotionRows.write(numbers(i), start(i), to, 0)
    to

  private def rows(i: Int, ray: Ray): Array[Double] =
    val space = ray.nested.space
    if i < staticCount then written(i, space)
    else
      motions(i - staticCount).write(ray.time, space, 0)
      space

object Instances:
  val Empty: Instances = of(Array.empty, IndexedSeqView.Id(Vector.empty))

  /** @param placements  (index into `objects`, object to world), which are made when asked for, as
    *   there may be millions; animated instances are numbered last, with the few whose matrix is
    *   nearly singular, and stays a pair. The numbers of [[MotionRow]]s
    *   are used where they are, if they are of the same [[MotionRows]] as the first
    * @param open, close shutter times
    */
  def of(
      objects: Array[Accelerator],
      placements: IndexedSeqView[(Int, Motion)],
      open: Float = 0f,
      close: Float = 1f,
      parallel: Parallel = Parallel.Alone
  ): Instances =
    val shared: MotionRows | Null =
      placements.iterator.map(_._2).collectFirst { case at: MotionRow => at.rows }.orNull
    val kinds = new Array[Byte](placements.length)
    parallel.ranges(placements.length): (from, until) =>
      loop(from, until)(i => kinds(i) = kind(placements(i)._2, shared).toByte)
    val indices = IntBuffer()
    loop(placements.length)(i => if kinds(i) == NoRow then indices += i)
    val withoutRow = indices.drain()
    val staticCount = placements.length - withoutRow.length
    val objectOf = new Array[Int](placements.length)
    val motions = new Array[Motion](withoutRow.length)
    loop(withoutRow.length): k =>
      val (objectIndex, motion) = placements(withoutRow(k))
      objectOf(staticCount + k) = objectIndex
      motions(k) = motion

    // Others follow those that are shared
    val hasOwn = kinds.exists(_ == OwnRow)
    val rows =
      if shared == null then MotionRows() else if hasOwn then shared.continued else shared
    val rowOf = new Array[Int](staticCount)
    var k = 0
    loop(placements.length): i =>
      if kinds(i) == OwnRow then rowOf(k) = rows.grow()
      if kinds(i) != NoRow then k += 1
    parallel.ranges(placements.length): (from, until) =>
      val work = new Array[Double](Motion.Work)
      // Those apart before `from`
      var passed = withoutRow.search(from).insertionPoint
      loop(from, until): i =>
        if kinds(i) == NoRow then passed += 1
        else
          val (objectIndex, motion) = placements(i)
          val k = i - passed
          objectOf(k) = objectIndex
          motion match
            case at: MotionRow if kinds(i) == SharedRow => rowOf(k) = at.row
            case _ =>
              motion.write(0f, work, 0)
              rows.store(rowOf(k), work)
    // Most scenes have the rows of their instances in order
    val numbers = if rowOf.indices.forall(k => rowOf(k) == k) then null else rowOf
    val moving = motions.count(_.moves)
    new Instances(objects, objectOf, rows.numbers, numbers, motions, moving, open, close)

  private inline val OwnRow = 0
  private inline val SharedRow = 1
  private inline val NoRow = 2

  private def kind(motion: Motion, shared: MotionRows | Null): Int = motion match
    case at: MotionRow if at.rows eq shared => SharedRow
    case _ => if motion.moves || !canHold(motion) then NoRow else OwnRow

  private def canHold(motion: Motion): Boolean =
    val work = new Array[Double](Motion.Work)
    motion.write(0f, work, 0)
    MotionRows.canHold(work)

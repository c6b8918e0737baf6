package candela.scene

import candela.accel.Instances
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.Warp
import candela.shapes.SurfaceSample

/** A point sampled on a caster; mutable, one per worker. */
final class CasterPoint:
  private[scene] val surface = SurfaceSample()

  /** As [[candela.geometry.Hit.primitive]] and `inner` of a ray that meets the point. */
  private[scene] var primitive, inner: Int = -1

  /** Distance within which a ray that meets the primitive has met the point. */
  private[scene] var reach: Float = 0f

  /** Where its primitive lies in the sum of all areas, from 0 to 1. */
  var areaFraction: Double = 0.0

  /** In world space. */
  def p: MutableVec3 = surface.p

/** The surfaces that cast caustics, whose points are sampled by area, or more often where an aim
  * says so. Immutable.
  *
  * Within an instance points are sampled by area in the object's space, as all instances of it
  * share a table.
  */
final class Casters private (
    world: CasterTable,
    objects: Array[CasterTable],
    placed: Placed,
    aim: CasterAim
):
  private val total = world.area + placed.area

  /** The same, with another aim. */
  def aimed(aim: CasterAim): Casters = new Casters(world, objects, placed, aim)

  /** No surface casts caustics. */
  def isEmpty: Boolean = total == 0.0

  /** Samples a point.
    *
    * @param choice of the primitive, in [0, 1)
    * @param ray    says at which time
    * @return false: no point was sampled
    */
  def sample(choice: Double, u1: Float, u2: Float, ray: Ray, out: CasterPoint): Boolean =
    out.areaFraction = aim.warp(choice)
    val target = out.areaFraction * total
    if target < world.area then
      out.primitive = world.sample(target, u1, u2, out)
      out.inner = -1
    else
      val i = placed.findInterval(target - world.area)
      val instance = placed.instances(i)
      val fraction = (target - world.area - placed.start(i)) / placed.areaOf(i)
      val table = objects(placed.allInstances.objectOf(instance))
      out.primitive = placed.first + instance
      out.inner = table.sample(Math.min(fraction, Casters.BelowOne) * table.area, u1, u2, out)
      out.surface.p = placed.allInstances.toWorld(instance, ray, out.p)
      out.reach *= placed.stretch(i)
    out.surface.pdf > 0f

  /** Has the ray met the sampled point, if it met a surface at `at`? */
  def isMet(point: CasterPoint, hit: Hit, at: ShadingPoint): Boolean =
    hit.primitive == point.primitive && (point.inner < 0 || hit.inner == point.inner) &&
      (at.p - point.p).lengthSquared <= square(point.reach)

  /** Density with which [[sample]] returns the point where a ray has met a caster, per area. */
  def density(ray: Ray, hit: Hit, at: ShadingPoint): Float =
    if hit.primitive < placed.first then
      val k = world.indexOf(hit.primitive)
      if k < 0 then 0f
      else
        val aimDensity = aim.density(world.start(k) / total, world.end(k) / total)
        (aimDensity * world.chance(hit.primitive, at.p) / total).toFloat
    else
      val instance = hit.primitive - placed.first
      val i = placed.indexOf(instance)
      if i < 0 then 0f
      else
        val table = objects(placed.allInstances.objectOf(instance))
        val k = table.indexOf(hit.inner)
        val scale = if k < 0 then 0.0 else placed.areaOf(i) / table.area
        val start = world.area + placed.start(i)
        val aimDensity =
          if k < 0 then 0.0
          else
            aim.density(
              (start + table.start(k) * scale) / total,
              (start + table.end(k) * scale) / total
            )
        val chance =
          if table.isEven(hit.inner) then 1.0
          else table.chance(hit.inner, placed.allInstances.toObject(instance, ray, at.p))
        val inObject = aimDensity * scale / total * chance
        (inObject * placed.allInstances.shrinkage(instance, ray, at.geometricNormal)).toFloat

object Casters:
  private inline val BelowOne = 1.0 - 1e-16

  /** Weight of the second number of a choice. */
  private inline val Finer = 1.0 / (1 << 24)

  /** Choice of a primitive, by two numbers in [0, 1): one has too few digits for millions. */
  def choice(u: Float, finer: Float): Double = u + finer * Finer

  /** @param casts whether a material casts caustics */
  def apply(surfaces: Surfaces, instanced: Instanced, casts: Array[Boolean]): Casters =
    val objects = instanced.objects.map(CasterTable(_, casts))
    new Casters(
      CasterTable(surfaces, casts),
      objects,
      Placed(instanced.instances, surfaces.count, objects),
      CasterAim.Even
    )

/** How often places in the sum of the casters' areas, from 0 to 1, are sampled. Immutable.
  *
  * @param ends probabilities of all cells up to each, of which there are as many as numbers; all
  *             cells are of equal size. Empty: places are sampled evenly
  */
final class CasterAim private (ends: Array[Double]):
  /** @param u uniform in [0, 1) */
  def warp(u: Double): Double =
    if ends.length == 0 then u
    else
      val cell = CasterTable.findInterval(ends, u)
      val start = if cell == 0 then 0.0 else ends(cell - 1)
      val fraction = Math.max(0.0, Math.min((u - start) / (ends(cell) - start), CasterAim.BelowOne))
      (cell + fraction) / ends.length

  /** Average density from one place to another. */
  def density(from: Double, to: Double): Double =
    if ends.length == 0 || to <= from then 1.0 else (upTo(to) - upTo(from)) / (to - from)

  private def upTo(position: Double): Double =
    val scaled = position * ends.length
    val cell = Math.min(scaled.toInt, ends.length - 1)
    val start = if cell == 0 then 0.0 else ends(cell - 1)
    start + (ends(cell) - start) * (scaled - cell)

object CasterAim:
  private inline val BelowOne = 1.0 - 1e-12

  /** By area. */
  val Even: CasterAim = new CasterAim(Array.emptyDoubleArray)

  /** In proportion to these weights, and to some part evenly: no place is left out.
    *
    * @param weights of cells of equal size, at least one
    * @param even    that part, above 0
    */
  def apply(weights: Array[Double], even: Double): CasterAim =
    val sum = weights.sum
    if !(sum > 0.0) then Even
    else
      val chances = weights.map(w => (1.0 - even) * w / sum + even / weights.length)
      val ends = chances.scanLeft(0.0)(_ + _).tail
      new CasterAim(ends.map(_ / ends.last))

/** Learns where paths begin that bring light, in equal cells of the casters' areas. Mutable. */
final class CasterLearning:
  import CasterLearning.*
  private val moments = new Array[Double](Cells)

  /** A path that began at `position` brings so much light. */
  def add(position: Double, light: Double): Unit =
    moments(Math.min((position * Cells).toInt, Cells - 1)) += light * light

  def addAll(other: CasterLearning): Unit =
    for i <- moments.indices do moments(i) += other.moments(i)

  /** No path has brought light. */
  def isEmpty: Boolean = moments.forall(_ == 0.0)

  /** Densities in proportion to the root of second moments have the least variance. */
  def aim: CasterAim = CasterAim(moments.map(Math.sqrt), Evenly)

private[candela] object CasterLearning:
  private inline val Cells = 512

  /** Part of the paths that begin anywhere. */
  private inline val Evenly = 0.2

/** The instances with casters.
  *
  * @param first number of the first instance among the primitives
  */
private final class Placed(
    val allInstances: Instances,
    val first: Int,
    objects: Array[CasterTable]
):
  val instances: Array[Int] =
    (0 until allInstances.count).filter(i => objects(allInstances.objectOf(i)).area > 0.0).toArray
  private val stretches: Array[Double] = instances.map(allInstances.stretch)
  private val ends: Array[Double] = instances.indices
    .map(i => objects(allInstances.objectOf(instances(i))).area * stretches(i) * stretches(i))
    .scanLeft(0.0)(_ + _).tail.toArray

  def area: Double = if ends.isEmpty then 0.0 else ends.last
  def start(i: Int): Double = if i == 0 then 0.0 else ends(i - 1)
  def areaOf(i: Int): Double = ends(i) - start(i)
  def stretch(i: Int): Float = stretches(i).toFloat
  def findInterval(position: Double): Int = CasterTable.findInterval(ends, position)

  /** Among these, −1: it has no casters. */
  def indexOf(instance: Int): Int =
    Math.max(-1, java.util.Arrays.binarySearch(instances, instance))

/** The casters among some surfaces, in their space. */
private final class CasterTable(surfaces: Surfaces, casts: Array[Boolean]):
  private val soup = surfaces.soup
  private val primitives: Array[Int] =
    (0 until surfaces.count).filter(i => casts(materialOf(i)) && areaOf(i) > 0.0).toArray
  private val ends: Array[Double] = primitives.map(areaOf).scanLeft(0.0)(_ + _).tail

  def area: Double = if ends.isEmpty then 0.0 else ends.last

  /** Among these, below 0: it is none of them. */
  def indexOf(primitive: Int): Int = java.util.Arrays.binarySearch(primitives, primitive)

  /** Where it lies in the sum of all areas. */
  def start(index: Int): Double = if index == 0 then 0.0 else ends(index - 1)
  def end(index: Int): Double = ends(index)

  /** Samples a point of the primitive at this place in the sum of all areas; returns its number. */
  def sample(position: Double, u1: Float, u2: Float, out: CasterPoint): Int =
    val primitive = primitives(CasterTable.findInterval(ends, position))
    val to = out.surface
    if primitive < soup.count then
      val b = Warp.uniformTriangle(u1, u2)
      val p = soup.vertex(primitive, 0)
      to.p = p + (soup.vertex(primitive, 1) - p) * b.x + (soup.vertex(primitive, 2) - p) * b.y
      to.pdf = 1f
      out.reach = Float.PositiveInfinity
    else
      val shape = surfaces.solids.shape(primitive - soup.count)
      shape.sampleArea(u1, u2, to)
      // A ray meets closed shapes twice, and other parts of them are farther away than this
      out.reach = CasterTable.RelativeReach * sqrt(shape.area)
    primitive

  /** Is [[chance]] 1 everywhere on the primitive? */
  def isEven(primitive: Int): Boolean = primitive < soup.count

  /** Density of the point `p`, times the whole area. */
  def chance(primitive: Int, p: Vec3): Double =
    if isEven(primitive) then 1.0
    else
      val shape = surfaces.solids.shape(primitive - soup.count)
      shape.area.toDouble * shape.areaPdf(p)

  private def materialOf(primitive: Int): Int =
    if primitive < soup.count then soup.meshes(soup.meshOf(primitive)).material
    else surfaces.solids.material(primitive - soup.count)

  private def areaOf(primitive: Int): Double =
    if primitive < soup.count then
      val p = soup.vertex(primitive, 0)
      val across = (soup.vertex(primitive, 1) - p) cross (soup.vertex(primitive, 2) - p)
      across.length * 0.5
    else
      val shape = surfaces.solids.shape(primitive - soup.count)
      val area = shape.area
      if area < Float.PositiveInfinity then area.toDouble else 0.0

private object CasterTable:
  private inline val RelativeReach = 1e-3f

  /** The first interval whose end is beyond `position`. */
  def findInterval(ends: Array[Double], position: Double): Int =
    var low = 0
    var high = ends.length - 1
    while low < high do
      val middle = (low + high) >>> 1
      if position < ends(middle) then high = middle else low = middle + 1
    low

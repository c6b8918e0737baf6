package candela.shapes

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** Surfaces that rays can hit, other than mesh triangles, by their numbers in a table of all: one
  * [[Shape]], or many that share their data. In world space, immutable.
  */
trait ShapeGroup:

  /** Writes the bounds of a surface; see [[Bounds3.write]]. */
  def writeBounds(number: Int, to: Array[Float], at: Int): Unit

  /** As [[Shape.intersect]]. */
  def intersect(number: Int, ray: Ray, hit: Hit): Boolean

  /** As [[Shape.isHit]]. */
  def isHit(number: Int, ray: Ray): Boolean

  /** As [[Shape.surface]]. */
  def surface(number: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit

  /** The surface alone; where many share their data, made for the caller. */
  def shape(number: Int): Shape

object ShapeGroup:
  // Most groups are single shapes, which rays ask without a call in between

  inline def intersect(all: Array[? <: ShapeGroup], i: Int, ray: Ray, hit: Hit): Boolean =
    all(i) match
      case one: Shape => one.intersect(ray, hit)
      case many => many.intersect(i, ray, hit)

  inline def isHit(all: Array[? <: ShapeGroup], i: Int, ray: Ray): Boolean =
    all(i) match
      case one: Shape => one.isHit(ray)
      case many => many.isHit(i, ray)

/** A surface that rays can hit, other than a mesh triangle; in world space, immutable. */
abstract class Shape extends SurfaceSampler, ShapeGroup:

  /** Bounds of the whole surface. */
  def bounds: Bounds3

  /** Writes them; see [[Bounds3.write]]. */
  def writeBounds(to: Array[Float], at: Int): Unit = bounds.write(to, at)

  /** Finds the closest hit in (0, `ray.tMax`) and sets `ray.tMax` to its distance; `hit.u` and
    * `hit.v` may store values for `surface`, `hit.primitive` is set by the caller.
    */
  def intersect(ray: Ray, hit: Hit): Boolean

  /** Whether the ray hits the shape in (0, `ray.tMax`); leaves the ray unchanged. */
  def isHit(ray: Ray): Boolean

  /** A cone that contains all outward normals: its unit axis, and the cosine of its half-angle. */
  def normals: (Vec3, Float)

  /** Computes the geometry of the hit that `intersect` found. */
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit

  final def writeBounds(number: Int, to: Array[Float], at: Int): Unit = writeBounds(to, at)
  final def intersect(number: Int, ray: Ray, hit: Hit): Boolean = intersect(ray, hit)
  final def isHit(number: Int, ray: Ray): Boolean = isHit(ray)
  final def surface(number: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    surface(ray, hit, at)
  final def shape(number: Int): Shape = this

  final def intersectSurface(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    val isMet = intersect(ray, hit)
    if isMet then surface(ray, hit, at)
    isMet

/** A surface whose points can be sampled, as required of an area light. */
abstract class SurfaceSampler:

  /** Area in world space. */
  def area: Float

  /** Samples a point that may be visible from `from`; `out.pdf` is 0 if there is none. */
  def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    sampleArea(u1, u2, out)
    out.pdf = SurfaceSampler.perSolidAngle(out.pdf, from, out.p, out.n)

  /** Pdf per solid angle at `from` with which `sample` returns the point `p` of this surface, whose
    * unit normal is `n`.
    */
  def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    SurfaceSampler.perSolidAngle(areaPdf(p), from, p, n)

  /** Samples a point of the whole surface, visible or not; `out.pdf` is per area. */
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit

  /** Pdf per area with which `sampleArea` returns the point `p` of this surface. */
  def areaPdf(p: Vec3): Float

  /** Whether the ray hits the surface in (0, `ray.tMax`); `at` then receives the geometry. */
  def intersectSurface(ray: Ray, hit: Hit, at: ShadingPoint): Boolean

/** A sampled point on a surface; mutable, one per worker. Its vectors are stored in place. */
final class SurfaceSample:
  private val ownP, ownPError = MutableVec3()
  private val ownN = MutableVec3(0f, 0f, 1f)

  def p: MutableVec3 = ownP
  def p_=(v: Vec3): Unit = ownP.set(v)

  /** Conservative error bound of `p`, per component. */
  def pError: MutableVec3 = ownPError
  def pError_=(v: Vec3): Unit = ownPError.set(v)

  /** Outward unit normal. */
  def n: MutableVec3 = ownN
  def n_=(v: Vec3): Unit = ownN.set(v)

  /** Pdf, per solid angle at the reference point, or per area. */
  var pdf: Float = 0f

  /** Scratch memory of [[TriangleSampler]] and [[RectangleSampler]]. */
  val triangle = candela.sampling.SphericalTriangle()
  val rectangle = candela.sampling.SphericalRectangle()

object SurfaceSampler:
  /** Range of solid angles in sr, from PBRT 4th ed., §6.5.4: below it the pdf by area is nearly
    * constant, above it the reference point is almost in the plane of the surface.
    */
  private inline val MinSolidAngle = 3e-4
  private inline val MaxSolidAngle = 6.22

  /** Is a flat surface of this solid angle sampled by it, rather than by area? */
  private[shapes] def isByAngle(solidAngle: Double): Boolean =
    solidAngle > MinSolidAngle && solidAngle < MaxSolidAngle

  /** Converts a pdf per area into one per solid angle: pdf · distance² / |cos|. Zero edge-on. */
  def perSolidAngle(perArea: Float, from: Vec3, p: Vec3, n: Vec3): Float =
    val d = p - from
    val distance2 = d.lengthSquared
    val cosine = Math.abs(d dot n) / sqrt(distance2)
    if cosine > 0f then perArea * distance2 / cosine else 0f

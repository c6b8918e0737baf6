package candela.shapes

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** A surface that rays can meet, other than a triangle of a mesh; in world space, immutable. */
abstract class Shape extends SurfaceSampler:

  /** Contains the whole surface. */
  def bounds: Bounds3

  /** Is there a hit in (0, `ray.tMax`)? Then `ray.tMax` becomes its distance; `hit.u` and `hit.v`
    * may hold what `surface` wants to know again, `hit.primitive` is left to the caller.
    */
  def intersect(ray: Ray, hit: Hit): Boolean

  /** The same question without the answer's details; the ray stays as it is. */
  def isHit(ray: Ray): Boolean

  /** A cone that holds all outside normals: its unit axis, and the cosine of its half-angle. */
  def normals: (Vec3, Float)

  /** Fills in the geometry of the hit that `intersect` found. */
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit

  final def meets(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    val isMet = intersect(ray, hit)
    if isMet then surface(ray, hit, at)
    isMet

/** A surface on which points can be chosen, as seen from a point: what an area light needs. */
abstract class SurfaceSampler:

  /** In square units of world space. */
  def area: Float

  /** Chooses a point that may be visible from `from`; `out.pdf` is 0 if there is none. */
  def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    sampleArea(u1, u2, out)
    out.pdf = SurfaceSampler.perSolidAngle(out.pdf, from, out.p, out.n)

  /** The density per solid angle at `from` with which `sample` returns the point `p` of this
    * surface, whose unit normal is `n`.
    */
  def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    SurfaceSampler.perSolidAngle(areaPdf(p), from, p, n)

  /** Chooses a point anywhere, wherever it is seen from; `out.pdf` is per area. */
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit

  /** The density per area with which `sampleArea` returns the point `p` of this surface. */
  def areaPdf(p: Vec3): Float

  /** Is there a hit in (0, `ray.tMax`)? Then `at` gets its geometry. */
  def meets(ray: Ray, hit: Hit, at: ShadingPoint): Boolean

/** A point on a surface; mutable, one per worker. Its vectors are stored in place. */
final class SurfaceSample:
  private val ownP, ownPError = MutableVec3()
  private val ownN = MutableVec3(0f, 0f, 1f)

  def p: MutableVec3 = ownP
  def p_=(v: Vec3): Unit = ownP.set(v)

  /** Conservative bound of the error of `p`, per component. */
  def pError: MutableVec3 = ownPError
  def pError_=(v: Vec3): Unit = ownPError.set(v)

  /** Unit normal on the outside. */
  def n: MutableVec3 = ownN
  def n_=(v: Vec3): Unit = ownN.set(v)

  /** Per solid angle at the point that asked, or per area. */
  var pdf: Float = 0f

  /** Work space of [[TriangleSampler]]. */
  val triangle = candela.sampling.SphericalTriangle()

object SurfaceSampler:
  /** Turns a density per area into one per solid angle: pdf · distance² / |cos|. Zero edge-on. */
  def perSolidAngle(perArea: Float, from: Vec3, p: Vec3, n: Vec3): Float =
    val d = p - from
    val distance2 = d.lengthSquared
    val cosine = Math.abs(d dot n) / sqrt(distance2)
    if cosine > 0f then perArea * distance2 / cosine else 0f

package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, Hit, Ray, ShadingPoint}
import candela.math.*

/** A source of light. Immutable. */
abstract class Light:

  /** Chooses a direction from `from` towards the light; `out.pdf` is 0 if none can bring light.
    *
    * @param work holds the surface sample of area lights
    */
  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit

  /** Is there any use in `sample`? Not if chance finds the light as well, or if it is black. */
  def isSampled: Boolean = true

  /** Does it shine to the other side than where rays see it shine? Then paths that start at it find
    * other light than those that meet it.
    */
  def isContrary: Boolean = false

  /** Can a ray never meet it by chance? Then only `sample` finds it. */
  def isDelta: Boolean

  /** Where it is and how strong, for choosing between lights; None: it is everywhere (at
    * infinity).
    */
  def bounds: Option[LightBounds]

  /** How much light it sends into the scene, on any scale common to all; 0: [[emit]] chooses
    * nothing, and the light is found from the other end alone.
    */
  def power(scene: Ball): Float

  /** Chooses place and direction of light that sets out into the scene. */
  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit

  /** The density with which [[emit]] chooses the point `p` of the light, with normal `n`, and the
    * direction `w` from there, in the measure of [[EmittedRay.pdf]].
    */
  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float

  /** The density with which `sample` at `from` chooses where `ray` started, in the measure that
    * makes it comparable to its own: of a surface per solid angle, times the cosine there; of a
    * point the square of the distance; of a direction 1; of surroundings per solid angle.
    */
  def meetingPdf(from: Vec3, ray: EmittedRay): Float

/** What [[Light.sample]] chose; mutable, one per worker. It owns its vectors. */
final class LightSample:
  private val ownWi = MutableVec3(0f, 0f, 1f)

  /** Unit vector towards the light. */
  def wi: MutableVec3 = ownWi
  def wi_=(v: Vec3): Unit = ownWi.set(v)

  /** Radiance that would arrive if nothing is in the way; for delta lights the irradiance on a
    * plane facing the light, with `pdf` 1.
    */
  var radiance: Rgb = Rgb.Black

  /** Per solid angle. */
  var pdf: Float = 0f

  /** The light is infinitely far away: a shadow ray has no end, and what follows is not set. */
  var isInfinite: Boolean = false

  /** The point on the light, where a shadow ray ends; with normal (zero for a point light). */
  val target = candela.shapes.SurfaceSample()

  /** Work space of [[PictureLight]]. */
  val ray = Ray()
  val hit = Hit()
  val at = ShadingPoint()

/** A light that is a surface in the scene. */
abstract class SurfaceLight extends Light:
  final def isDelta: Boolean = false

  /** Radiance that leaves the surface at `at` in direction `w`. */
  def radiance(at: ShadingPoint, w: Vec3): Rgb

  /** The density with which `sample` at `from` chooses the point `at`, per solid angle. */
  def pdf(from: Vec3, at: ShadingPoint): Float

/** A light that surrounds the scene: what rays see that leave it. */
abstract class EnvironmentLight extends Light:
  final def isDelta: Boolean = false
  final def bounds: Option[LightBounds] = None

  /** ∫ of the radiance over all directions, of the brightest colour or of the mean one. */
  protected def total: Float

  def power(scene: Ball): Float = scene.area * total

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    sample(scene.center, v1, v2, out.sample)
    out.fromAfar(-out.sample.wi, scene, u1, u2)
    out.radiance = out.sample.radiance
    out.pdf = if scene.area > 0f then out.sample.pdf / scene.area else 0f

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    if scene.area > 0f then pdf(scene.center, -w) / scene.area else 0f

  def meetingPdf(from: Vec3, ray: EmittedRay): Float = pdf(from, -ray.direction)

  /** Radiance at `from` from direction `d` (unit, away from the scene). */
  def radiance(from: Vec3, d: Vec3): Rgb

  /** The density with which `sample` at `from` chooses `d`, per solid angle. */
  def pdf(from: Vec3, d: Vec3): Float

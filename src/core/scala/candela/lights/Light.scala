package candela.lights

import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Ball, Hit, Ray, ShadingPoint}
import candela.math.*

/** A light source. Immutable. */
abstract class Light:

  /** Samples a direction from `from` towards the light; sets `out.pdf` to 0 if no light can arrive.
    */
  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit

  /** Whether `sample` is useful; false if the light is black, or if it is left to the path alone,
    * which meets it with as little noise.
    */
  def isSampled: Boolean = true

  /** Whether the light illuminates the other side than the one rays see emitting; light and camera
    * paths then find different light.
    */
  def isContrary: Boolean = false

  /** Whether only the camera sees the light, directly or by specular scattering. */
  def isShownOnly: Boolean = false

  /** Whether the camera sees the light; if not, only what it lights, and reflections of it. */
  def isInView: Boolean = true

  /** May light paths start here that compete with the camera's and with light samples? Not where
    * either finds what the other doesn't.
    */
  final def isCausticSource: Boolean = isSampled && !isContrary && !isShownOnly

  /** Whether the light comes from infinity, through the border of the scene. */
  def isInfinite: Boolean = false

  /** This light, if it is on a surface of the scene. */
  def asSurface: SurfaceLight | Null = null

  /** This light, if rays that escape the scene find it. */
  def asEnvironment: EnvironmentLight | Null = null

  /** Whether rays can never hit the light, and only `sample` finds it. */
  def isDelta: Boolean

  /** Bounds for importance sampling of lights; None for lights at infinity. */
  def bounds: Option[LightBounds]

  /** Power emitted into the scene, in a unit common to all lights; 0 if [[emit]] samples nothing,
    * and only camera subpaths find the light.
    */
  def power(scene: Ball): Float

  /** Samples the origin and direction of a ray that enters the scene. */
  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit

  /** Pdf with which [[emit]] samples the point `p` of the light, with normal `n`, and the direction
    * `w`, in the measure of [[EmittedRay.pdf]].
    */
  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float

  /** Pdf with which `sample` at `from` samples the origin of `ray`, in the measure that makes it
    * comparable to the light's own pdf: for a surface, per solid angle, times the cosine there; for
    * a point light, the squared distance; for a directional light, 1; for infinite lights, per
    * solid angle.
    */
  def connectionPdf(from: Vec3, ray: EmittedRay): Float

/** Answers as `source` does whatever is asked of all lights, but for their samples and bounds. */
trait WrappedLight(source: Light) extends Light:
  override def isSampled: Boolean = source.isSampled
  override def isContrary: Boolean = source.isContrary
  override def isShownOnly: Boolean = source.isShownOnly
  override def isInView: Boolean = source.isInView
  override def isInfinite: Boolean = source.isInfinite
  override def power(scene: Ball): Float = source.power(scene)
  override def emit(
      scene: Ball,
      u1: Float,
      u2: Float,
      v1: Float,
      v2: Float,
      out: EmittedRay
  ): Unit = source.emit(scene, u1, u2, v1, v2, out)
  override def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    source.emissionPdf(scene, p, n, w)
  override def connectionPdf(from: Vec3, ray: EmittedRay): Float = source.connectionPdf(from, ray)

/** An area light whose emission is that of `even`, scaled; directions are sampled as for that. */
abstract class ModulatedLight(even: SurfaceLight) extends SurfaceLight, WrappedLight(even):
  /** Upper bound or mean of the scale, for light selection. */
  protected def strength: Float

  def pdf(from: Vec3, at: ShadingPoint): Float = even.pdf(from, at)
  override def power(scene: Ball): Float = even.power(scene) * strength
  def bounds: Option[LightBounds] = even.bounds.map(b => b.copy(power = b.power * strength))

/** Result of [[Light.sample]]; mutable, one per worker. It owns its vectors. */
final class LightSample:
  private val ownWi = MutableVec3(0f, 0f, 1f)
  private val ownRadiance = MutableRgb()
  private val imagePlace = MutableVec3()
  private var deferred: ImageEnvironment | Null = null

  /** Unit vector towards the light. */
  def wi: MutableVec3 = ownWi
  def wi_=(v: Vec3): Unit = ownWi.set(v)

  /** Unoccluded incident radiance; for delta lights, the irradiance on a plane facing the light,
    * with `pdf` 1.
    */
  def radiance: MutableRgb =
    val light = deferred
    if light != null then radiance = light.radianceAt(imagePlace, wi)
    ownRadiance
  def radiance_=(c: Rgb): Unit =
    deferred = null
    ownRadiance.set(c)

  /** Looks the radiance up in the light's image only when it is asked for, as it is not where the
    * sample is occluded.
    */
  private[lights] def defer(light: ImageEnvironment, place: Vec3): Unit =
    deferred = light
    imagePlace.set(place)

  /** May the light arrive? */
  def isLit: Boolean = pdf > 0f && (deferred != null || !ownRadiance.isBlack)

  /** Pdf per solid angle. */
  var pdf: Float = 0f

  /** Whether the light is at infinity: the shadow ray is then unbounded, and the fields below are
    * not set.
    */
  var isInfinite: Boolean = false

  /** The point on the light at which a shadow ray ends, with its normal (zero for a point light).
    */
  val target = candela.shapes.SurfaceSample()

  /** Scratch memory of [[PictureLight]]. */
  val ray = Ray()
  val hit = Hit()
  val point = ShadingPoint()

/** A light that is a surface in the scene. */
abstract class SurfaceLight extends Light:
  final def isDelta: Boolean = false
  final override def asSurface: SurfaceLight = this

  /** Radiance emitted at `at` in direction `w`. */
  def radiance(at: ShadingPoint, w: Vec3): Rgb

  /** Pdf with which `sample` at `from` samples the point `at`, per solid angle. */
  def pdf(from: Vec3, at: ShadingPoint): Float

/** An infinite light: the radiance of rays that escape the scene. */
abstract class EnvironmentLight extends Light:
  final def isDelta: Boolean = false
  override def isInfinite: Boolean = true
  final override def asEnvironment: EnvironmentLight = this
  final def bounds: Option[LightBounds] = None

  /** ∫ of the radiance over all directions, of the largest or the mean component. */
  protected def total: Float

  def power(scene: Ball): Float = scene.area * total

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    sample(scene.center, v1, v2, out.sample)
    out.fromAfar(-out.sample.wi, scene, u1, u2)
    out.radiance = out.sample.radiance.toRgb
    out.pdf = if scene.area > 0f then out.sample.pdf / scene.area else 0f

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    if scene.area > 0f then pdf(scene.center, -w) / scene.area else 0f

  def connectionPdf(from: Vec3, ray: EmittedRay): Float = pdf(from, -ray.direction)

  /** Radiance at `from` from direction `d` (unit, away from the scene). */
  def radiance(from: Vec3, d: Vec3): Rgb

  /** Pdf with which `sample` at `from` samples `d`, per solid angle. */
  def pdf(from: Vec3, d: Vec3): Float

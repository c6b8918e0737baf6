package candela.lights

import candela.color.Rgb
import candela.geometry.{Hit, Ray, ShadingPoint}
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

  /** Can a ray never meet it by chance? Then only `sample` finds it. */
  def isDelta: Boolean

  /** Where it is and how strong, for choosing between lights; None: it is everywhere (at
    * infinity).
    */
  def bounds: Option[LightBounds]

/** What [[Light.sample]] chose; mutable, one per worker. */
final class LightSample:
  /** Unit vector towards the light. */
  var wi: Vec3 = Vec3.Z

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

  /** Radiance at `from` from direction `d` (unit, away from the scene). */
  def radiance(from: Vec3, d: Vec3): Rgb

  /** The density with which `sample` at `from` chooses `d`, per solid angle. */
  def pdf(from: Vec3, d: Vec3): Float

package candela.media

import candela.color.Rgb
import candela.geometry.{Bounds3, Ray}
import candela.math.*
import candela.sampling.PhaseFunction

/** A box filled with a medium of varying density: pbrt-v2's volumes. Unlike a [[Medium]] it needs
  * no bounding surface, and several may overlap. Immutable.
  *
  * @param toWorld from volume space, in which `box` is given
  * @param filling coefficients of the medium
  */
abstract class Region(toWorld: Transform, box: Bounds3, filling: Filling):
  private val toVolume = toWorld.inverse
  val scattering: Rgb = filling.scattering
  val extinction: Rgb = filling.absorption + filling.scattering
  val emitted: Rgb = filling.emitted
  val phase: PhaseFunction = filling.phase

  /** Density at a point of volume space within the box. */
  protected def density(p: Vec3): Float

  /** Whether the density is constant in the box. */
  def isUniform: Boolean

  def describe: String

  /** The corners of its box. */
  final def corners: Iterable[Vec3] = (0 until 8).map(i => toWorld.point(box.corner(i)))

  final def densityAt(world: Vec3): Float =
    val p = toVolume.point(world)
    val isInside = p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
      p.z >= box.min.z && p.z <= box.max.z
    if isInside then density(p) else 0f

  /** Sets `overlap` to the part of the ray between `from` and `to` that is in the box. */
  final def clip(ray: Ray, from: Float, to: Float, overlap: Overlap): Boolean =
    val o = toVolume.point(ray.origin)
    val d = toVolume.vector(ray.direction)
    overlap.start = from
    overlap.end = to
    overlap.cut(o.x, d.x, box.min.x, box.max.x)
    overlap.cut(o.y, d.y, box.min.y, box.max.y)
    overlap.cut(o.z, d.z, box.min.z, box.max.z)
    overlap.start <= overlap.end

/** Coefficients of a [[Region]].
  *
  * @param absorption, scattering, emitted  at a density of 1, per scene unit
  */
final case class Filling(absorption: Rgb, scattering: Rgb, emitted: Rgb, phase: PhaseFunction)

/** An interval of a ray; mutable. */
final class Overlap:
  var start, end = 0f

  /** Clips to the slab between two planes perpendicular to an axis. */
  private[media] def cut(o: Float, d: Float, low: Float, high: Float): Unit =
    if d == 0f then
      if o < low || o > high then end = Float.NegativeInfinity
    else
      val a = (low - o) / d
      val b = (high - o) / d
      start = Math.max(start, Math.min(a, b))
      end = Math.min(end, Math.max(a, b))

/** Constant density in a box. */
final class UniformRegion(toWorld: Transform, box: Bounds3, filling: Filling)
    extends Region(toWorld, box, filling):
  def isUniform: Boolean = true
  def describe: String = "homogeneous"
  protected def density(p: Vec3): Float = 1f

/** Density that decreases exponentially with height above the box's lowest corner.
  *
  * @param up     axis of height (unit)
  * @param ground density at height 0
  * @param fall   decrease of its logarithm, per unit of volume space
  */
final class ExponentialRegion(
    toWorld: Transform,
    box: Bounds3,
    filling: Filling,
    up: Vec3,
    ground: Float,
    fall: Float
) extends Region(toWorld, box, filling):
  def isUniform: Boolean = false
  def describe: String = "exponential"
  protected def density(p: Vec3): Float = ground * exp(-fall * ((p - box.min) dot up))

/** A grid of densities. */
final class GridRegion(
    toWorld: Transform,
    box: Bounds3,
    filling: Filling,
    grid: SampledGrid
) extends Region(toWorld, box, filling):
  private val size = box.extent
  def isUniform: Boolean = false
  def describe: String = s"grid ${grid.describe}"

  protected def density(p: Vec3): Float = grid(
    (p.x - box.min.x) / size.x,
    (p.y - box.min.y) / size.y,
    (p.z - box.min.z) / size.z
  )

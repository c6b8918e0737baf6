package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, Frame, ShadingPoint}
import candela.math.*
import candela.sampling.Warp
import candela.shapes.SurfaceSample

/** Where light sets out, as [[Light.emit]] chose it; mutable, one per worker. */
final class EmittedRay:
  /** Where it leaves the light; of a light at infinity, a place outside of the scene. */
  var p, pError: Vec3 = Vec3.Zero

  /** Of the light's surface there; zero if it has none. */
  var n: Vec3 = Vec3.Zero

  /** In which it travels. */
  var direction: Vec3 = Vec3.Z

  /** Radiance of surfaces and surroundings, intensity of points, irradiance of parallel light. */
  var radiance: Rgb = Rgb.Black

  /** Density of place and direction: per area and solid angle, as far as these are chosen; 0: no
    * light sets out.
    */
  var pdf: Float = 0f
  var isInfinite: Boolean = false

  /** Work space. */
  val surface = SurfaceSample()
  private[lights] val sample = LightSample()

  /** Of the angle between direction and surface; 1 without a surface. */
  def cosine: Float = if n.isZero then 1f else n absDot direction

  /** The light that this ray stands for. */
  def power: Rgb = if pdf > 0f then radiance * (cosine / pdf) else Rgb.Black

  def origin: Vec3 = if n.isZero then p else ShadingPoint.offset(p, pError, n, direction)

  /** From a point, into all directions alike. */
  private[lights] def fromPoint(position: Vec3): Unit =
    p = position
    pError = Vec3.Zero
    n = Vec3.Zero
    isInfinite = false

  /** Of parallel light along `w`: starts on a disc as wide as the scene, before it. */
  private[lights] def fromAfar(w: Vec3, ball: Ball, u1: Float, u2: Float): Unit =
    val disk = Warp.concentricDisk(u1, u2)
    val across = Frame.around(w).toWorld(Vec3(disk.x, disk.y, -1f))
    p = ball.center + across * ball.radius
    pError = Vec3.Zero
    n = Vec3.Zero
    direction = w
    isInfinite = true

package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, Frame, ShadingPoint}
import candela.math.*
import candela.sampling.Warp
import candela.shapes.SurfaceSample

/** A ray leaving a light, sampled by [[Light.emit]]; mutable, one per worker. */
final class EmittedRay:
  private val ownP, ownPError, ownN = MutableVec3()
  private val ownDirection = MutableVec3(0f, 0f, 1f)

  /** Origin on the light; for a light at infinity, a point outside the scene. */
  def p: MutableVec3 = ownP
  def p_=(v: Vec3): Unit = ownP.set(v)
  def pError: MutableVec3 = ownPError
  def pError_=(v: Vec3): Unit = ownPError.set(v)

  /** Normal of the light's surface at `p`; zero if the light has no surface. */
  def n: MutableVec3 = ownN
  def n_=(v: Vec3): Unit = ownN.set(v)

  /** Direction of travel. */
  def direction: MutableVec3 = ownDirection
  def direction_=(v: Vec3): Unit = ownDirection.set(v)

  /** Radiance of surfaces and infinite lights, intensity of point lights, irradiance of directional
    * lights.
    */
  var radiance: Rgb = Rgb.Black

  /** Pdf of position and direction, per area and solid angle where they are sampled; 0 if no light
    * is emitted.
    */
  var pdf: Float = 0f
  var isInfinite: Boolean = false

  /** Scratch memory. */
  val surface = SurfaceSample()
  private[lights] val sample = LightSample()

  /** Cosine between direction and surface normal; 1 without a surface. */
  def cosine: Float = if n.isZero then 1f else n absDot direction

  /** Power carried by this ray: the Monte Carlo weight of the sample. */
  def power: Rgb = if pdf > 0f then radiance * (cosine / pdf) else Rgb.Black

  def origin: Vec3 = if n.isZero then p.toVec3 else ShadingPoint.offset(p, pError, n, direction)

  /** Sets the ray to leave a point uniformly in all directions. */
  private[lights] def fromPoint(position: Vec3): Unit =
    p = position
    pError = Vec3.Zero
    n = Vec3.Zero
    isInfinite = false

  /** Sets a parallel ray along `w`, starting on a disk outside the scene that covers its bounding
    * sphere.
    */
  private[lights] def fromAfar(w: Vec3, ball: Ball, u1: Float, u2: Float): Unit =
    val disk = Warp.concentricDisk(u1, u2)
    val across = Frame.fromZ(w).toWorld(Vec3(disk.x, disk.y, -1f))
    p = ball.center + across * ball.radius
    pError = Vec3.Zero
    n = Vec3.Zero
    direction = w
    isInfinite = true

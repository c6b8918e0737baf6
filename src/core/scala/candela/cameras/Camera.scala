package candela.cameras

import candela.geometry.Ray
import candela.math.{MutableVec3, Vec3}

/** Film size.
  *
  * @param width    of the full image in pixels, as `height`
  * @param diagonal of the film in metres; used only by cameras with a lens system
  */
final case class FilmFrame(width: Int, height: Int, diagonal: Float = 0.035f)

/** Raster position at which a scene point is visible through a point of the aperture. Mutable, one
  * per worker.
  */
final class FilmPlace:
  private val ownEye = MutableVec3()
  private val ownDirection = MutableVec3(0f, 0f, 1f)

  /** Raster position in the coordinates of [[Camera.generate]]; may be outside the film. */
  var x, y: Float = 0f

  /** The point of the aperture, in world space. */
  def eye: MutableVec3 = ownEye
  def eye_=(v: Vec3): Unit = ownEye.set(v)

  /** Direction from the visible point to the eye. */
  def direction: MutableVec3 = ownDirection
  def direction_=(v: Vec3): Unit = ownDirection.set(v)

  /** If film positions are uniformly sampled: the pdf with which a ray from `eye` arrives, per area
    * perpendicular to the ray.
    */
  var density: Float = 0f

/** Maps film positions to rays in world space. */
abstract class Camera:

  /** Generates the ray through the film at (`x`, `y`).
    *
    * @param x in pixels from the left edge of the full image, `y` from its top
    * @param lensU with `lensV` a point in the unit square, for the aperture
    */
  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit

  /** Whether rays depend on the point of the aperture. */
  def hasLens: Boolean = true

  /** Whether rays have different weights. If so, `generate` sets `ray.weight`; 0 means that no
    * light reaches the film there, and leaves the ray unchanged. Otherwise the weight is neither
    * set nor read.
    */
  def weighs: Boolean = false

  /** Whether the camera can map scene points to the film: [[project]] and [[density]] are then
    * implemented.
    */
  def isTraceable: Boolean = false

  /** Finds the film position from which a ray through (`lensU`, `lensV`) arrives at `p`; false if
    * there is none.
    */
  def project(p: Vec3, lensU: Float, lensV: Float, out: FilmPlace): Boolean = false

  /** [[FilmPlace.density]] at `p` of a ray that started at `eye`. */
  def density(eye: Vec3, p: Vec3): Float = 0f

  /** Pixel offset of the neighbours that `differential` uses. */
  protected[cameras] def step: Float = 1f

  /** Sets the differential of a ray that `generate` has written, from the rays one pixel to the
    * right and one below, through the same point of the aperture.
    *
    * @param scale   scale of the offsets: a pixel's samples are closer together
    * @param scratch overwritten
    */
  final def differential(
      x: Float,
      y: Float,
      lensU: Float,
      lensV: Float,
      scale: Float,
      ray: Ray,
      scratch: Ray
  ): Unit =
    val neighbours = ray.differential
    val across = reaches(x + step, y, lensU, lensV, scratch)
    val alongX =
      if across || reaches(x - step, y, lensU, lensV, scratch) then
        val share = if across then scale / step else -scale / step
        neighbours.xOrigin = interpolate(ray.origin, scratch.origin, share)
        neighbours.xDirection = interpolate(ray.direction, scratch.direction, share)
        true
      else false
    val down = reaches(x, y + step, lensU, lensV, scratch)
    val alongY =
      if down || reaches(x, y - step, lensU, lensV, scratch) then
        val share = if down then scale / step else -scale / step
        neighbours.yOrigin = interpolate(ray.origin, scratch.origin, share)
        neighbours.yDirection = interpolate(ray.direction, scratch.direction, share)
        true
      else false
    neighbours.isKnown = alongX && alongY

  private def interpolate(a: Vec3, b: Vec3, share: Float): Vec3 = a + (b - a) * share

  /** Generates a ray; false if the lens system blocks it. */
  private def reaches(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Boolean =
    generate(x, y, lensU, lensV, ray)
    !weighs || ray.weight > 0f

package candela.cameras

import candela.geometry.Ray
import candela.math.Vec3

/** How large the film is.
  *
  * @param width    of the full image in pixels, as `height`
  * @param diagonal of the film in metres; only cameras with lenses of glass ask for it
  */
final case class FilmFrame(width: Int, height: Int, diagonal: Float = 0.035f)

/** Where on the film a point of the scene is seen, through one point of the aperture. Mutable, one
  * per worker.
  */
final class FilmPlace:
  /** As [[Camera.generate]] takes them; perhaps beside the film. */
  var x, y: Float = 0f

  /** The point of the aperture, in the world. */
  var eye: Vec3 = Vec3.Zero

  /** From the seen point to the eye. */
  var direction: Vec3 = Vec3.Z

  /** If places are chosen all over the film: the density with which a ray from `eye` arrives, per
    * area across the ray.
    */
  var density: Float = 0f

/** Turns a place on the film into a ray into the world. */
abstract class Camera:

  /** Writes the ray through the film at (`x`, `y`).
    *
    * @param x in pixels from the left edge of the full image, `y` from its top
    * @param lensU with `lensV` a point in the unit square, for the aperture
    */
  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit

  /** Do rays differ in what their light counts? Then `generate` sets `ray.weight`; at 0 no light
    * reaches the film there, and the ray itself is left as it was. All others leave the weight
    * alone, and nobody looks at it.
    */
  def weighs: Boolean = false

  /** Does it know where a point is seen? Then [[see]] and [[density]] have answers. */
  def isTraceable: Boolean = false

  /** Finds the place on the film from which a ray through (`lensU`, `lensV`) comes to `p`; false if
    * there is none.
    */
  def see(p: Vec3, lensU: Float, lensV: Float, out: FilmPlace): Boolean = false

  /** [[FilmPlace.density]] of a ray that started at `eye`, at `p`. */
  def density(eye: Vec3, p: Vec3): Float = 0f

  /** How far away the neighbours lie that `differential` takes, in pixels. */
  protected[cameras] def step: Float = 1f

  /** Fills in the differential of a ray that `generate` has written, from the rays one pixel to the
    * right and one below, through the same point of the aperture.
    *
    * @param scale   by which its rays are moved towards the first: samples of a pixel lie closer
    * @param scratch is written to
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
        neighbours.xOrigin = between(ray.origin, scratch.origin, share)
        neighbours.xDirection = between(ray.direction, scratch.direction, share)
        true
      else false
    val down = reaches(x, y + step, lensU, lensV, scratch)
    val alongY =
      if down || reaches(x, y - step, lensU, lensV, scratch) then
        val share = if down then scale / step else -scale / step
        neighbours.yOrigin = between(ray.origin, scratch.origin, share)
        neighbours.yDirection = between(ray.direction, scratch.direction, share)
        true
      else false
    neighbours.isKnown = alongX && alongY

  private def between(a: Vec3, b: Vec3, share: Float): Vec3 = a + (b - a) * share

  /** Generates a ray; false if the lenses let none through. */
  private def reaches(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Boolean =
    generate(x, y, lensU, lensV, ray)
    !weighs || ray.weight > 0f

package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** Shutter interval, in the scene's unit of time. */
final case class Shutter(open: Float, close: Float):
  def duration: Float = close - open

  /** Maps a number in [0, 1) to a time. */
  def at(u: Float): Float = lerp(u, open, close)

/** An animated camera: each ray uses the transform at its time.
  *
  * @param camera  at the origin, looking along +z
  * @param toWorld its animated transform
  */
final class MovingCamera(val camera: Camera, val toWorld: Motion) extends Camera:
  override def weighs: Boolean = camera.weighs
  override def hasLens: Boolean = camera.hasLens
  override protected[cameras] def step: Float = camera.step

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    camera.generate(x, y, lensU, lensV, ray)
    val m = ray.nested.space
    toWorld.write(ray.time, m, 0)
    val o = ray.origin
    val d = ray.direction
    def along(r: Int, v: Vec3) = m(r) * v.x + m(r + 1) * v.y + m(r + 2) * v.z
    val origin = Vec3(
      (along(0, o) + m(3)).toFloat,
      (along(4, o) + m(7)).toFloat,
      (along(8, o) + m(11)).toFloat
    )
    val direction = Vec3(along(0, d).toFloat, along(4, d).toFloat, along(8, d).toFloat)
    ray.set(origin, direction.normalized, ray.tMax)

package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** When the shutter is open, in the scene's unit of time. */
final case class Shutter(open: Float, close: Float):
  def duration: Float = close - open

  /** The time that a number in [0, 1) stands for. */
  def at(u: Float): Float = lerp(u, open, close)

/** A camera that moves while the shutter is open: each ray leaves it where it is at the ray's time.
  *
  * @param camera  stands at the origin and looks along +z
  * @param toWorld moves it
  */
final class MovingCamera(camera: Camera, toWorld: Motion) extends Camera:
  override def weighs: Boolean = camera.weighs
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

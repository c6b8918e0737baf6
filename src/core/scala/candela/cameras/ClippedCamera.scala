package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** A camera that sees only what lies between two planes, as Mitsuba's do.
  *
  * @param near, far distances of the planes along the viewing axis, in camera space
  */
final class ClippedCamera(camera: Camera, cameraToWorld: Transform, near: Float, far: Float)
    extends Camera:
  private val toCamera = cameraToWorld.inverse

  override def weighs: Boolean = camera.weighs
  override def hasLens: Boolean = camera.hasLens
  override def isTraceable: Boolean = camera.isTraceable
  override protected[cameras] def step: Float = camera.step

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    camera.generate(x, y, lensU, lensV, ray)
    val d = ray.direction
    val depth = toCamera.vector(d).z
    ray.set(ray.origin + d * (near / depth), d, (far - near) / depth)

  override def project(p: Vec3, lensU: Float, lensV: Float, out: FilmPlace): Boolean =
    val depth = toCamera.point(p).z
    depth >= near && depth <= far && camera.project(p, lensU, lensV, out)

  override def density(eye: Vec3, p: Vec3): Float = camera.density(eye, p)

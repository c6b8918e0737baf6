package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** What both projective cameras share: the film's place in camera space.
  *
  * @param screen        left, right, bottom, top of the film on the plane z = 1 of camera space,
  *                      before the field of view is applied
  * @param lensRadius    0: a pinhole
  * @param focalDistance along the viewing axis, to the plane of sharp focus
  */
final case class ProjectiveSetup(
    cameraToWorld: Transform,
    width: Int,
    height: Int,
    screen: (Float, Float, Float, Float),
    lensRadius: Float,
    focalDistance: Float
)

/** Shared geometry, in world space and ready to use. */
abstract class ProjectiveCamera(setup: ProjectiveSetup) extends Camera:
  private val (left, right, bottom, top) = setup.screen
  private val stepX = (right - left) / setup.width
  private val stepY = (bottom - top) / setup.height
  protected val eye: Vec3 = setup.cameraToWorld.point(Vec3.Zero)
  protected val axisX: Vec3 = setup.cameraToWorld.vector(Vec3.X)
  protected val axisY: Vec3 = setup.cameraToWorld.vector(Vec3.Y)
  protected val axisZ: Vec3 = setup.cameraToWorld.vector(Vec3.Z)
  protected val hasLens: Boolean = setup.lensRadius > 0f

  /** Camera-space coordinates of the film point, on the unit screen. */
  protected final def screenX(x: Float): Float = left + x * stepX
  protected final def screenY(y: Float): Float = top + y * stepY

  /** World-space vector with the given camera-space coordinates. */
  protected final def world(x: Float, y: Float, z: Float): Vec3 = Vec3(
    axisX.x * x + axisY.x * y + axisZ.x * z,
    axisX.y * x + axisY.y * y + axisZ.y * z,
    axisX.z * x + axisY.z * y + axisZ.z * z
  )

  /** Starts the ray on the lens at (u, v), which lies around the axis, through the point of the
    * plane of focus that the pinhole ray from camera-space (`ox`, `oy`, 0) along (`dx`, `dy`, 1)
    * meets.
    */
  protected final def throughLens(
      ox: Float,
      oy: Float,
      dx: Float,
      dy: Float,
      u: Float,
      v: Float,
      ray: Ray
  ): Unit =
    val disk = candela.sampling.Warp.concentricDisk(u, v)
    val lx = disk.x * setup.lensRadius
    val ly = disk.y * setup.lensRadius
    val f = setup.focalDistance
    val direction = world(ox + dx * f - lx, oy + dy * f - ly, f)
    ray.set(eye + world(lx, ly, 0f), direction.normalized, Float.PositiveInfinity)

/** A pinhole or thin-lens camera.
  *
  * @param fov full angle in degrees that [-1, 1] of the screen spans
  *
  * Source: Kolb, Mitchell, Hanrahan, "A Realistic Camera Model for Computer Graphics", SIGGRAPH
  * 1995, for the thin lens; PBRT 3rd ed., §6.2.
  */
final class PerspectiveCamera(setup: ProjectiveSetup, fov: Float) extends ProjectiveCamera(setup):
  private val spread = Math.tan(Math.toRadians(fov.toDouble) / 2).toFloat

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    val dx = screenX(x) * spread
    val dy = screenY(y) * spread
    if hasLens then throughLens(0f, 0f, dx, dy, lensU, lensV, ray)
    else ray.set(eye, world(dx, dy, 1f).normalized, Float.PositiveInfinity)

/** Parallel projection along +z of camera space; the screen is in units of camera space.
  *
  * With a lens all rays start on it, as in every pbrt: what lies before or behind the plane of
  * focus is then seen as by a perspective camera.
  */
final class OrthographicCamera(setup: ProjectiveSetup) extends ProjectiveCamera(setup):

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    val sx = screenX(x)
    val sy = screenY(y)
    if hasLens then throughLens(sx, sy, 0f, 0f, lensU, lensV, ray)
    else ray.set(eye + world(sx, sy, 0f), axisZ.normalized, Float.PositiveInfinity)

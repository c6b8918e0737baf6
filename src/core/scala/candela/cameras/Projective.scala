package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** Common parameters of projective cameras: the film's position in camera space.
  *
  * @param screen        left, right, bottom, top of the film on the plane z = 1 of camera space,
  *   before the field of view is applied
  * @param lensRadius    0 for a pinhole
  * @param focalDistance distance along the viewing axis to the plane of focus
  */
final case class ProjectiveSetup(
    cameraToWorld: Transform,
    width: Int,
    height: Int,
    screen: (Float, Float, Float, Float),
    lensRadius: Float,
    focalDistance: Float
)

/** Common base of projective cameras, with precomputed world-space geometry. */
abstract class ProjectiveCamera(setup: ProjectiveSetup) extends Camera:
  private val (left, right, bottom, top) = setup.screen
  private val stepX = (right - left) / setup.width
  private val stepY = (bottom - top) / setup.height
  protected val eye: Vec3 = setup.cameraToWorld.point(Vec3.Zero)
  protected val axisX: Vec3 = setup.cameraToWorld.vector(Vec3.X)
  protected val axisY: Vec3 = setup.cameraToWorld.vector(Vec3.Y)
  protected val axisZ: Vec3 = setup.cameraToWorld.vector(Vec3.Z)
  final override val hasLens: Boolean = setup.lensRadius > 0f

  private val toCamera = setup.cameraToWorld.inverse

  /** World volume of a unit cube of camera space. */
  private val volume = Math.abs(setup.cameraToWorld.determinant)

  /** Area of the screen. */
  protected val screenArea: Float = Math.abs((right - left) * (bottom - top))

  override def isTraceable: Boolean = volume > 0 && screenArea > 0f

  protected final def filmX(onScreen: Float): Float = (onScreen - left) / stepX
  protected final def filmY(onScreen: Float): Float = (onScreen - top) / stepY

  /** Finds the film position of `c`, a point in camera space in front of the camera, seen from
    * (`lx`, `ly`, 0).
    */
  protected def locate(c: Vec3, lx: Float, ly: Float, out: FilmPlace): Unit

  /** Pdf at `c` of rays from `eye`, per area perpendicular to the ray; both in camera space. */
  protected def densityInside(eye: Vec3, c: Vec3): Float

  final override def project(p: Vec3, lensU: Float, lensV: Float, out: FilmPlace): Boolean =
    val c = toCamera.point(p)
    if !(c.z > 0f) then false
    else
      val disk =
        if hasLens then candela.sampling.Warp.concentricDisk(lensU, lensV) else Vec3.Zero
      val lx = disk.x * setup.lensRadius
      val ly = disk.y * setup.lensRadius
      locate(c, lx, ly, out)
      val d = out.eye - p
      out.direction = d * (1f / d.length)
      out.density = density(out.eye, p)
      true

  final override def density(eye: Vec3, p: Vec3): Float =
    val from = toCamera.point(eye)
    val to = toCamera.point(p)
    // A linear map scales volumes by its determinant; hence it scales areas perpendicular to a
    // direction by the determinant over the direction's scale
    val d = to - from
    val stretch = world(d.x, d.y, d.z).length / d.length
    (densityInside(from, to) * (stretch / volume)).toFloat

  /** Pdf of rays from one point through the whole screen, of area `area` at z = 1. */
  protected final def fanDensity(eye: Vec3, c: Vec3, area: Float): Float =
    val d = c - eye
    val distance2 = d.lengthSquared
    val cosine = d.z / sqrt(distance2)
    if cosine > 0f then 1f / (area * cosine * cosine * cosine * distance2) else 0f

  /** Intersection of the plane of focus with the line from the lens to `c`. */
  protected final def focusX(c: Vec3, lx: Float): Float =
    lx + (c.x - lx) * (setup.focalDistance / c.z)
  protected final def focusY(c: Vec3, ly: Float): Float =
    ly + (c.y - ly) * (setup.focalDistance / c.z)

  /** Camera-space coordinates of the film point, on the unit screen. */
  protected final def screenX(x: Float): Float = left + x * stepX
  protected final def screenY(y: Float): Float = top + y * stepY

  /** World-space vector with the given camera-space coordinates. */
  protected final def world(x: Float, y: Float, z: Float): Vec3 = Vec3(
    axisX.x * x + axisY.x * y + axisZ.x * z,
    axisX.y * x + axisY.y * y + axisZ.y * z,
    axisX.z * x + axisY.z * y + axisZ.z * z
  )

  /** Starts the ray on the lens at (u, v), around the axis, towards the point at which the pinhole
    * ray from camera-space (`ox`, `oy`, 0) along (`dx`, `dy`, 1) hits the plane of focus.
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

  protected def locate(c: Vec3, lx: Float, ly: Float, out: FilmPlace): Unit =
    val f = setup.focalDistance
    out.eye = if hasLens then eye + world(lx, ly, 0f) else eye
    out.x = filmX((if hasLens then focusX(c, lx) / f else c.x / c.z) / spread)
    out.y = filmY((if hasLens then focusY(c, ly) / f else c.y / c.z) / spread)

  protected def densityInside(eye: Vec3, c: Vec3): Float =
    fanDensity(eye, c, screenArea * spread * spread)

/** Orthographic camera along +z of camera space; the screen is in units of camera space.
  *
  * With a lens all rays start on it, as in all pbrt versions: points off the plane of focus then
  * appear as by a perspective camera.
  */
final class OrthographicCamera(setup: ProjectiveSetup) extends ProjectiveCamera(setup):

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    val sx = screenX(x)
    val sy = screenY(y)
    if hasLens then throughLens(sx, sy, 0f, 0f, lensU, lensV, ray)
    else ray.set(eye + world(sx, sy, 0f), axisZ.normalized, Float.PositiveInfinity)

  protected def locate(c: Vec3, lx: Float, ly: Float, out: FilmPlace): Unit =
    out.eye = eye + (if hasLens then world(lx, ly, 0f) else world(c.x, c.y, 0f))
    out.x = filmX(if hasLens then focusX(c, lx) else c.x)
    out.y = filmY(if hasLens then focusY(c, ly) else c.y)

  protected def densityInside(eye: Vec3, c: Vec3): Float =
    if hasLens then fanDensity(eye, c, screenArea / (setup.focalDistance * setup.focalDistance))
    else 1f / screenArea

package candela.cameras

import candela.geometry.{Ray, ShadingPoint}
import candela.math.*

/** Approximate footprint of a pixel at any surface point, as if the camera saw the point: pbrt-v4's
  * fallback for rays without differentials. Uses the camera's smallest pixel footprint, so as not
  * to blur too much.
  *
  * @param eye      position of the camera
  * @param stepX    between the origins of neighbouring rays (orthographic cameras), with `stepY`
  * @param turnX    between their unit directions (perspective cameras), with `turnY`
  * @param scale    scale by the sample density
  */
final class PixelCone(
    eye: Vec3,
    stepX: Float,
    stepY: Float,
    turnX: Float,
    turnY: Float,
    scale: Float
):
  private val zX = 1f - 0.5f * square(turnX)
  private val zY = 1f - 0.5f * square(turnY)

  /** Sets `at.dpdx` and `at.dpdy`. Written in scalars: the JIT does not keep the vectors of so long
    * an expression off the heap.
    */
  def approximateFootprint(at: ShadingPoint): Unit =
    val p = at.p
    val x = p.x - eye.x
    val y = p.y - eye.y
    val z = p.z - eye.z
    val distance = sqrt(x * x + y * y + z * z)
    val isApart = distance > 0f
    val inverse = if isApart then 1f / distance else 0f
    // The basis of Frame.fromZ the unit vector from the eye
    val nx = x * inverse
    val ny = y * inverse
    val nz = if isApart then z * inverse else 1f
    val sign = Math.copySign(1f, nz)
    val a = -1f / (sign + nz)
    val b = nx * ny * a
    val sx = 1f + sign * nx * nx * a
    val sy = sign * b
    val sz = -sign * nx
    val tx = b
    val ty = sign + ny * ny * a
    val tz = -ny
    val normal = at.geometricNormal
    val normalX = normal.x * sx + normal.y * sy + normal.z * sz
    val normalY = normal.x * tx + normal.y * ty + normal.z * tz
    val normalZ = normal.x * nx + normal.y * ny + normal.z * nz

    // From the point to where the ray of the next pixel meets the tangent plane: origin (ox, oy, 0)
    // and direction (dx, dy, dz) in the basis
    inline def meeting(ox: Float, oy: Float, dx: Float, dy: Float, dz: Float, out: MutableVec3) =
      val above = distance * normalZ - (ox * normalX + oy * normalY)
      val t = above / (dx * normalX + dy * normalY + dz * normalZ)
      val isHit = java.lang.Float.isFinite(t)
      val u = if isHit then ox + dx * t else 0f
      val v = if isHit then oy + dy * t else 0f
      val w = if isHit then dz * t - distance else 0f
      out.set(
        (sx * u + tx * v + nx * w) * scale,
        (sy * u + ty * v + ny * w) * scale,
        (sz * u + tz * v + nz * w) * scale
      )
    meeting(stepX, 0f, turnX, 0f, zX, at.dpdx)
    meeting(0f, stepY, 0f, turnY, zY, at.dpdy)

object PixelCone:
  /** Rays along the image's diagonal, of which the closest neighbours are used. */
  private val Probes = 512

  def of(camera: Camera, eye: Vec3, width: Int, height: Int, scale: Float): PixelCone =
    val ray = Ray()
    val scratch = Ray()
    val differentials = (0 until Probes).flatMap: i =>
      val fraction = i.toFloat / (Probes - 1)
      val x = fraction * width
      val y = fraction * height
      camera.generate(x, y, 0.5f, 0.5f, ray)
      val isRay = !camera.weighs || ray.weight > 0f
      if isRay then camera.differential(x, y, 0.5f, 0.5f, 1f, ray, scratch)
      val d = ray.differential
      Option.when(isRay && d.isKnown):
        Array(
          (d.xOrigin - ray.origin).length,
          (d.yOrigin - ray.origin).length,
          (d.xDirection - ray.direction).length,
          (d.yDirection - ray.direction).length
        )
    def smallest(k: Int) = differentials.map(_(k)).minOption.getOrElse(0f)
    PixelCone(eye, smallest(0), smallest(1), smallest(2), smallest(3), scale)

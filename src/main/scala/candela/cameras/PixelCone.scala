package candela.cameras

import candela.geometry.{Frame, Ray, ShadingPoint}
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
  private val directionX = Vec3(turnX, 0f, 1f - 0.5f * square(turnX))
  private val directionY = Vec3(0f, turnY, 1f - 0.5f * square(turnY))

  /** Sets `at.dpdx` and `at.dpdy`. */
  def meet(at: ShadingPoint): Unit =
    val along = at.p - eye
    val distance = along.length
    val isApart = distance > 0f
    val inverse = if isApart then 1f / distance else 0f
    // A single Vec3 for all cases: the compiler keeps only that off the heap
    val axis = Vec3(along.x * inverse, along.y * inverse, if isApart then along.z * inverse else 1f)
    val frame = Frame.around(axis)
    val n = frame.toLocal(at.geometricNormal)
    at.dpdx = frame.toWorld(meeting(Vec3(stepX, 0f, 0f), directionX, n, distance)) * scale
    at.dpdy = frame.toWorld(meeting(Vec3(0f, stepY, 0f), directionY, n, distance)) * scale

  /** Vector from the point at `distance` along z to the offset ray's hit with its tangent plane.
    */
  private def meeting(o: Vec3, d: Vec3, n: Vec3, distance: Float): Vec3 =
    val p = Vec3(0f, 0f, distance)
    val t = ((p - o) dot n) / (d dot n)
    val meets = java.lang.Float.isFinite(t)
    val v = o + d * t - p
    Vec3(if meets then v.x else 0f, if meets then v.y else 0f, if meets then v.z else 0f)

object PixelCone:
  /** Rays along the image's diagonal, of which the closest neighbours are used. */
  private val Probes = 512

  def of(camera: Camera, eye: Vec3, width: Int, height: Int, scale: Float): PixelCone =
    val ray = Ray()
    val scratch = Ray()
    val found = (0 until Probes).flatMap: i =>
      val part = i.toFloat / (Probes - 1)
      val x = part * width
      val y = part * height
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
    def least(k: Int) = found.map(_(k)).minOption.getOrElse(0f)
    PixelCone(eye, least(0), least(1), least(2), least(3), scale)

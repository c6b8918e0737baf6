package candela.shapes

import candela.geometry.{Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** Geometry of hits on [[CurveSegments]], which own these arrays. Follows pbrt, even in the normals
  * of flat and cylinder curves, which point away from the ray's origin in their middle.
  */
private[shapes] final class CurveSurface(
    points: Array[Float],
    params: Array[Float],
    widths: Array[Float],
    walk: CurveWalk,
    kind: CurveKind,
    space: Option[Transform],
    flipped: Boolean,
    errorWidths: Float
):
  private val toWorld = space.getOrElse(Transform.Identity)
  private val toObject = toWorld.inverse

  def fill(segment: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val direction =
      (if space.isEmpty then ray.direction else toObject.vector(ray.direction)).normalized
    val u = hit.u.toFloat
    val u0 = params(2 * segment)
    val uSpan = params(2 * segment + 1) - u0
    val s = (u - u0) / uSpan
    val dpdu = tangent(segment, s) * (1f / uSpan)
    val w = lerp(s, widths(2 * segment), widths(2 * segment + 1))
    val width =
      if kind != CurveKind.Ribbon then w
      else w * walk.facing(segment, hit.u, direction.x, direction.y, direction.z).toFloat
    val dpdv = across(segment, hit, direction, dpdu) * width
    at.p = ray.at(ray.tMax)
    val toHit = at.p - ray.origin
    // A ray that leaves a ribbon seen edge-on may hit it again face-on
    at.pError = error(Math.max(errorWidths * width, 0.5f * w)) + Vec3(
      (Math.abs(ray.ox) + Math.abs(toHit.x)) * gamma(3),
      (Math.abs(ray.oy) + Math.abs(toHit.y)) * gamma(3),
      (Math.abs(ray.oz) + Math.abs(toHit.z)) * gamma(3)
    )
    at.u = u
    at.v = hit.v.toFloat
    val n = toWorld.normal(dpdu cross dpdv).normalized
    at.geometricNormal = if flipped then -n else n
    at.frame.set(Frame.along(at.geometricNormal, toWorld.vector(dpdu)))
    // As in pbrt, the normal is assumed constant
    if at.wantsPartials then
      at.setPartials(toWorld.vector(dpdu), toWorld.vector(dpdv), Vec3.Zero, Vec3.Zero)

  /** Derivative by s in [0, 1] along the segment. */
  private def tangent(segment: Int, s: Float): Vec3 =
    val m = 1f - s
    val d = (control(segment, 1) - control(segment, 0)) * (3f * m * m) +
      (control(segment, 2) - control(segment, 1)) * (6f * m * s) +
      (control(segment, 3) - control(segment, 2)) * (3f * s * s)
    if d.isZero then control(segment, 3) - control(segment, 0) else d

  private def control(segment: Int, k: Int): Vec3 =
    val i = 12 * segment + 3 * k
    Vec3(points(i), points(i + 1), points(i + 2))

  /** Direction of ∂p/∂v. */
  private def across(segment: Int, hit: Hit, direction: Vec3, dpdu: Vec3): Vec3 = kind match
    case CurveKind.Ribbon => (walk.normal(segment, hit.u) cross dpdu).normalized
    case CurveKind.Flat => CurveSurface.sideways(direction, dpdu)
    case CurveKind.Cylinder =>
      // Rotated about the curve by −90° to 90° from edge to edge
      val flat = CurveSurface.sideways(direction, dpdu)
      val angle = (0.5f - hit.v.toFloat) * Pi
      flat * cos(angle) + (dpdu.normalized cross flat) * sin(angle)

  private def error(e: Float): Vec3 =
    if space.isEmpty then Vec3(e, e, e)
    else
      val m = toWorld.m
      def row(r: Int) =
        ((Math.abs(m(r)) + Math.abs(m(r + 1)) + Math.abs(m(r + 2))) * e).toFloat
      Vec3(row(0), row(4), row(8))

private[shapes] object CurveSurface:
  /** Unit vector perpendicular to a curve and to the ray; arbitrary if they are parallel. */
  private def sideways(direction: Vec3, dpdu: Vec3): Vec3 =
    val across = direction cross dpdu
    if across.isZero then Frame.fromZ(direction).s else across.normalized

package candela.shapes

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** One of [[CurveSegments]], which hold all its data. Turning towards every ray it has no surface
  * of its own, so that no point on it can be chosen: it can't be a light.
  */
final class CurveSegment(segments: CurveSegments, index: Int) extends Shape:
  def bounds: Bounds3 = segments.bounds(index)
  def intersect(ray: Ray, hit: Hit): Boolean = segments.intersect(index, ray, hit)
  def isHit(ray: Ray): Boolean = segments.isHit(index, ray)
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit = segments.surface(index, ray, hit, at)
  def normals: (Vec3, Float) = (Vec3.Z, -1f)
  def area: Float = 0f
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit = out.pdf = 0f
  def areaPdf(p: Vec3): Float = 0f

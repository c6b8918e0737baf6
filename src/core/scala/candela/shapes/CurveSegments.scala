package candela.shapes

import candela.base.loop
import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*

/** Thin strips along cubic Bézier curves, split into segments with a box each: hair, grass, wool.
  *
  * A ray hits a segment if it passes the curve within half its width, as projected onto the plane
  * perpendicular to the ray (Nakamaru and Ohno, "Ray Tracing for Curves Primitive", Journal of WSCG
  * 10, 2002; Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., §3.7).
  *
  * @param points  twelve Floats per segment: its four control points
  * @param params  two Floats per segment: its range of the curve's u in [0, 1]
  * @param widths  two Floats per segment: its width at either end
  * @param normals for ribbons six Floats per segment: unit normals at both ends of the *curve*
  * @param space   space of points, widths and normals; if empty, world space
  * @param flipped whether the normal is −∂p/∂u × ∂p/∂v
  * @param errorWidths offset of spawned rays, in widths
  */
final class CurveSegments(
    points: Array[Float],
    params: Array[Float],
    widths: Array[Float],
    normals: Array[Float],
    kind: CurveKind,
    space: Option[Transform],
    flipped: Boolean,
    errorWidths: Float
):
  private val walk =
    CurveWalk(params, widths, if kind == CurveKind.Ribbon then normals else Array.empty)
  private val geometry =
    CurveSurface(points, params, widths, walk, kind, space, flipped, errorWidths)
  private val inWorld = space.isEmpty
  private val toObject = space.getOrElse(Transform.Identity).inverseM

  def count: Int = points.length / 12

  def bounds(segment: Int): Bounds3 =
    val box = new Array[Float](6)
    writeBounds(segment, box, 0)
    Bounds3.read(box, 0)

  /** Without objects in world space, as there may be millions. */
  def writeBounds(segment: Int, to: Array[Float], at: Int): Unit =
    val halfWidth = 0.5f * Math.max(widths(2 * segment), widths(2 * segment + 1))
    val p = points
    loop(3): axis =>
      val i = 12 * segment + axis
      val low = Math.min(Math.min(Math.min(p(i), p(i + 3)), p(i + 6)), p(i + 9))
      val high = Math.max(Math.max(Math.max(p(i), p(i + 3)), p(i + 6)), p(i + 9))
      to(at + axis) = low - halfWidth
      to(at + 3 + axis) = high + halfWidth
    if !inWorld then space.foreach(t => Bounds3.read(to, at).mapped(t.point(_)).write(to, at))
    loop(3): axis =>
      val reach = Math.max(Math.abs(to(at + axis)), Math.abs(to(at + 3 + axis)))
      val pad = TriangleSoup.roundingError(reach)
      to(at + axis) -= pad
      to(at + 3 + axis) += pad

  /** Finds the closest hit in (0, `ray.tMax`) and shortens the ray; `hit` receives u along the
    * curve and v across it.
    */
  def intersect(segment: Int, ray: Ray, hit: Hit): Boolean = test(segment, ray, hit, write = true)

  def isHit(segment: Int, ray: Ray): Boolean =
    test(segment, ray, CurveSegments.NoHit, write = false)

  private def test(segment: Int, ray: Ray, hit: Hit, write: Boolean): Boolean =
    var ox = ray.ox.toDouble
    var oy = ray.oy.toDouble
    var oz = ray.oz.toDouble
    var dx = ray.dx.toDouble
    var dy = ray.dy.toDouble
    var dz = ray.dz.toDouble
    if !inWorld then
      val m = toObject
      val px = ox
      val py = oy
      val pz = oz
      ox = m(0) * px + m(1) * py + m(2) * pz + m(3)
      oy = m(4) * px + m(5) * py + m(6) * pz + m(7)
      oz = m(8) * px + m(9) * py + m(10) * pz + m(11)
      val ex = dx
      val ey = dy
      val ez = dz
      dx = m(0) * ex + m(1) * ey + m(2) * ez
      dy = m(4) * ex + m(5) * ey + m(6) * ez
      dz = m(8) * ex + m(9) * ey + m(10) * ez
    val p = points
    val i = 12 * segment
    // Perpendicular to the ray: y also perpendicular to the chord, which makes the segment thin in
    // y
    val cx = p(i + 9).toDouble - p(i)
    val cy = p(i + 10).toDouble - p(i + 1)
    val cz = p(i + 11).toDouble - p(i + 2)
    var yx = dy * cz - dz * cy
    var yy = dz * cx - dx * cz
    var yz = dx * cy - dy * cx
    var y2 = yx * yx + yy * yy + yz * yz
    if !(y2 > 1e-24 * (cx * cx + cy * cy + cz * cz) * (dx * dx + dy * dy + dz * dz)) then
      // The chord is parallel to the ray: any perpendicular direction
      if Math.abs(dx) > Math.abs(dy) then
        yx = -dz
        yy = 0.0
        yz = dx
      else
        yx = 0.0
        yy = dz
        yz = -dy
      y2 = yx * yx + yy * yy + yz * yz
    val yScale = 1.0 / Math.sqrt(y2)
    val halfWidth = 0.5 * Math.max(widths(2 * segment), widths(2 * segment + 1))
    val ax = p(i) - ox
    val ay = p(i + 1) - oy
    val az = p(i + 2) - oz
    val bx = p(i + 3) - ox
    val by = p(i + 4) - oy
    val bz = p(i + 5) - oz
    val ex = p(i + 6) - ox
    val ey = p(i + 7) - oy
    val ez = p(i + 8) - oz
    val fx = p(i + 9) - ox
    val fy = p(i + 10) - oy
    val fz = p(i + 11) - oz
    val y0 = (ax * yx + ay * yy + az * yz) * yScale
    val y1 = (bx * yx + by * yy + bz * yz) * yScale
    val y2_ = (ex * yx + ey * yy + ez * yz) * yScale
    val y3 = (fx * yx + fy * yy + fz * yz) * yScale
    if CurveWalk.apart(y0, y1, y2_, y3, halfWidth) then false
    else
      val length = Math.sqrt(dx * dx + dy * dy + dz * dz)
      // z along the ray, x = y × z
      val zScale = 1.0 / length
      val xx = (yy * dz - yz * dy) * yScale * zScale
      val xy = (yz * dx - yx * dz) * yScale * zScale
      val xz = (yx * dy - yy * dx) * yScale * zScale
      val x0 = ax * xx + ay * xy + az * xz
      val x1 = bx * xx + by * xy + bz * xz
      val x2 = ex * xx + ey * xy + ez * xz
      val x3 = fx * xx + fy * xy + fz * xz
      if CurveWalk.apart(x0, x1, x2, x3, halfWidth) then false
      else
        val z0 = (ax * dx + ay * dy + az * dz) * zScale
        val z1 = (bx * dx + by * dy + bz * dz) * zScale
        val z2 = (ex * dx + ey * dy + ez * dz) * zScale
        val z3 = (fx * dx + fy * dy + fz * dz) * zScale
        val bend = Math.max(
          CurveWalk.bend(x0, x1, x2, x3),
          Math.max(CurveWalk.bend(y0, y1, y2_, y3), CurveWalk.bend(z0, z1, z2, z3))
        )
        walk.refine(
          x0,
          y0,
          z0,
          x1,
          y1,
          z1,
          x2,
          y2_,
          z2,
          x3,
          y3,
          z3,
          0.0,
          1.0,
          CurveWalk.depth(bend, halfWidth),
          segment,
          dx * zScale,
          dy * zScale,
          dz * zScale,
          length,
          ray,
          hit,
          write
        )

  /** Computes the geometry of the hit that `intersect` found. */
  def surface(segment: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    geometry.fill(segment, ray, hit, at)

object CurveSegments:
  /** Never written to. */
  private val NoHit = Hit()

/** A segment of [[CurveSegments]], which hold all its data. It faces every ray and has no surface
  * of its own, so points on it can't be sampled: it can't be a light.
  */
final class CurveSegment(segments: CurveSegments, index: Int) extends Shape:
  def bounds: Bounds3 = segments.bounds(index)
  override def writeBounds(to: Array[Float], at: Int): Unit = segments.writeBounds(index, to, at)
  def intersect(ray: Ray, hit: Hit): Boolean = segments.intersect(index, ray, hit)
  def isHit(ray: Ray): Boolean = segments.isHit(index, ray)
  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit = segments.surface(index, ray, hit, at)
  def normals: (Vec3, Float) = (Vec3.Z, -1f)
  def area: Float = 0f
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit = out.pdf = 0f
  def areaPdf(p: Vec3): Float = 0f

/** All segments of [[CurveSegments]], from the number `first` on. */
final class CurveGroup(segments: CurveSegments, first: Int) extends ShapeGroup:
  def writeBounds(number: Int, to: Array[Float], at: Int): Unit =
    segments.writeBounds(number - first, to, at)
  def intersect(number: Int, ray: Ray, hit: Hit): Boolean =
    segments.intersect(number - first, ray, hit)
  def isHit(number: Int, ray: Ray): Boolean = segments.isHit(number - first, ray)
  def surface(number: Int, ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    segments.surface(number - first, ray, hit, at)
  def shape(number: Int): Shape = CurveSegment(segments, number - first)

/** Cross-section of a curve. */
enum CurveKind:
  /** A strip that faces every ray. */
  case Flat

  /** A strip that faces every ray, with the normals of a cylinder. */
  case Cylinder

  /** A strip oriented by its normals. */
  case Ribbon

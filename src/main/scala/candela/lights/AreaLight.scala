package candela.lights

import candela.color.Rgb
import candela.geometry.{Bounds3, ShadingPoint}
import candela.math.*
import candela.shapes.SurfaceSampler

/** A surface that emits the same `emitted` radiance from each point in all directions of its
  * outside (`twoSided`: of both sides).
  *
  * @param box contains the surface
  * @param axis mean of its normals, and the cosine of the largest angle that a normal makes with it
  */
final class AreaLight(
    surface: SurfaceSampler,
    emitted: Rgb,
    twoSided: Boolean,
    box: Bounds3,
    axis: Vec3,
    cosSpread: Float
) extends SurfaceLight:

  def radiance(at: ShadingPoint, w: Vec3): Rgb =
    if twoSided || (w dot at.geometricNormal) > 0f then emitted else Rgb.Black

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val target = out.target
    surface.sample(from, u1, u2, target)
    val d = target.p - from
    val length2 = d.lengthSquared
    out.pdf = 0f
    if target.pdf > 0f && length2 > 0f then
      val wi = d * (1f / sqrt(length2))
      if twoSided || (wi dot target.n) < 0f then
        out.wi = wi
        out.radiance = emitted
        out.pdf = target.pdf
        out.isInfinite = false

  def pdf(from: Vec3, at: ShadingPoint): Float = surface.pdf(from, at.p, at.geometricNormal)

  def bounds: Option[LightBounds] =
    val power = emitted.max * surface.area * Pi * (if twoSided then 2f else 1f)
    Some(LightBounds(box, axis, cosSpread, 0f, power, twoSided))

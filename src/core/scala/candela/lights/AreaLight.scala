package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, Bounds3, Frame, ShadingPoint}
import candela.math.*
import candela.sampling.Warp
import candela.shapes.SurfaceSampler

/** Diffuse area light: uniform `emitted` radiance from each point on the outside (`twoSided`: from
  * both sides).
  *
  * @param box  bounds of the surface
  * @param axis mean normal of the surface, and the cosine of the largest angle between a normal and
  *   it
  * @param isContrary whether rays see the emission on the other side than light sampling does
  */
final class AreaLight(
    surface: SurfaceSampler,
    emitted: Rgb,
    twoSided: Boolean,
    box: Bounds3,
    axis: Vec3,
    cosSpread: Float,
    override val isContrary: Boolean = false,
    override val isInView: Boolean = true
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

  private val watts: Float = emitted.max * surface.area * Pi * (if twoSided then 2f else 1f)

  def bounds: Option[LightBounds] =
    Some(LightBounds(box, axis, cosSpread, 0f, watts, twoSided))

  def power(scene: Ball): Float = watts

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    val point = out.surface
    surface.sampleArea(u1, u2, point)
    out.p = point.p
    out.pError = point.pError
    out.n = point.n
    // Each side takes one half of the sample range
    val isInside = twoSided && v1 < 0.5f
    val first = if !twoSided then v1 else if isInside then 2f * v1 else 2f * v1 - 1f
    val normal = if isInside then -point.n else point.n
    out.direction = Frame.fromZ(normal).toWorld(Warp.cosineHemisphere(first, v2))
    out.radiance = emitted
    out.isInfinite = false
    out.pdf = point.pdf * sided(out.direction dot normal)

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    val cosine = w dot n
    surface.areaPdf(p) * sided(if twoSided then Math.abs(cosine) else cosine)

  /** Pdf of a direction, per solid angle. */
  private def sided(cosine: Float): Float =
    Warp.cosineHemispherePdf(cosine) * (if twoSided then 0.5f else 1f)

  def connectionPdf(from: Vec3, ray: EmittedRay): Float =
    surface.pdf(from, ray.p, ray.n) * ray.cosine

/** A surface that is seen to emit, but lights nothing: an area light on a shape of an object, in
  * pbrt-v2 and v3.
  */
final class ShownLight(light: SurfaceLight) extends SurfaceLight, WrappedLight(light):
  override def isShownOnly: Boolean = true
  override def isSampled: Boolean = false
  def radiance(at: ShadingPoint, w: Vec3): Rgb = light.radiance(at, w)
  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit = out.pdf = 0f
  def pdf(from: Vec3, at: ShadingPoint): Float = 0f
  def bounds: Option[LightBounds] = None
  override def power(scene: Ball): Float = 0f
  override def emit(
      scene: Ball,
      u1: Float,
      u2: Float,
      v1: Float,
      v2: Float,
      out: EmittedRay
  ): Unit = ()
  override def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float = 0f
  override def connectionPdf(from: Vec3, ray: EmittedRay): Float = 0f

/** A light-emitting but invisible surface: pbrt-v4's emitters with `alpha` 0. Rays never hit it;
  * only [[sample]] finds it.
  */
final class HiddenLight(light: SurfaceLight) extends Light, WrappedLight(light):
  def isDelta: Boolean = true
  def bounds: Option[LightBounds] = light.bounds
  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    light.sample(from, u1, u2, out)

package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.math.*
import candela.shapes.SurfaceSampler

/** A surface that shows a picture over its u and v (v up), each of its points shining evenly.
  *
  * @param plain of the same surface, emitting the factor of the picture
  */
final class PictureLight(plain: AreaLight, surface: SurfaceSampler, picture: Picture)
    extends SurfaceLight:

  def radiance(at: ShadingPoint, w: Vec3): Rgb =
    val light = plain.radiance(at, w)
    if light.isBlack then light else light * shown(at)

  private def shown(at: ShadingPoint): Rgb = picture(at.u, 1f - at.v)

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    plain.sample(from, u1, u2, out)
    if out.pdf > 0f then
      // What the ray meets first is either the chosen point or hides it
      out.ray.set(from, out.wi, Float.PositiveInfinity)
      if surface.meets(out.ray, out.hit, out.at) then out.radiance = out.radiance * shown(out.at)
      else out.pdf = 0f

  def pdf(from: Vec3, at: ShadingPoint): Float = plain.pdf(from, at)

  private lazy val mean: Float = picture.mean((c, _, _) => c.max)

  def power(scene: Ball): Float = plain.power(scene) * mean

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    plain.emit(scene, u1, u2, v1, v2, out)
    if out.pdf > 0f then
      // A look back at the point, from so close that nothing of a smooth surface is between
      val work = out.sample
      val start = out.p + out.direction * (PictureLight.Near * sqrt(surface.area))
      work.ray.set(start, -out.direction, Float.PositiveInfinity)
      if surface.meets(work.ray, work.hit, work.at) then
        out.radiance = out.radiance * shown(work.at)
      else out.pdf = 0f

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    plain.emissionPdf(scene, p, n, w)

  def meetingPdf(from: Vec3, ray: EmittedRay): Float = plain.meetingPdf(from, ray)

  def bounds: Option[LightBounds] =
    plain.bounds.map(b => b.copy(power = b.power * mean))

object PictureLight:
  /** Part of the surface's extent. */
  private val Near = 1e-2f

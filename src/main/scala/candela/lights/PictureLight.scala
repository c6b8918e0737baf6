package candela.lights

import candela.color.Rgb
import candela.geometry.ShadingPoint
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

  def bounds: Option[LightBounds] =
    val mean = picture.mean((c, _, _) => c.max)
    plain.bounds.map(b => b.copy(power = b.power * mean))

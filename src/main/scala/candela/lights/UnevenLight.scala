package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.math.*
import candela.shapes.SurfaceSampler

/** A surface whose points shine unlike: a factor for each of what `even` emits. Points are chosen
  * as if all shone alike, and looked at then.
  *
  * @param even of the same surface
  */
abstract class UnevenLight(even: SurfaceLight, surface: SurfaceSampler) extends SurfaceLight:

  /** Of the emission that is sampled at a point. */
  protected def factor(at: ShadingPoint): Rgb

  /** An upper bound of the factor, or its mean: for how often the light is chosen. */
  protected def strength: Float

  override def isContrary: Boolean = even.isContrary

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    even.sample(from, u1, u2, out)
    if out.pdf > 0f then
      // What the ray meets first is either the chosen point or hides it
      out.ray.set(from, out.wi, Float.PositiveInfinity)
      if surface.meets(out.ray, out.hit, out.at) then out.radiance = out.radiance * factor(out.at)
      else out.pdf = 0f

  def pdf(from: Vec3, at: ShadingPoint): Float = even.pdf(from, at)

  def power(scene: Ball): Float = even.power(scene) * strength

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    even.emit(scene, u1, u2, v1, v2, out)
    if out.pdf > 0f then
      // A look back at the point, from so close that nothing of a smooth surface is between
      val work = out.sample
      val start = out.p + out.direction * (UnevenLight.Near * sqrt(surface.area))
      work.ray.set(start, -out.direction, Float.PositiveInfinity)
      if surface.meets(work.ray, work.hit, work.at) then
        out.radiance = out.radiance * factor(work.at)
      else out.pdf = 0f

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    even.emissionPdf(scene, p, n, w)

  def meetingPdf(from: Vec3, ray: EmittedRay): Float = even.meetingPdf(from, ray)

  def bounds: Option[LightBounds] =
    even.bounds.map(b => b.copy(power = b.power * strength))

object UnevenLight:
  /** Part of the surface's extent. */
  private val Near = 1e-2f

/** A surface that shows a picture over its u and v (v up), each of its points shining evenly.
  *
  * @param plain of the same surface, emitting the factor of the picture
  */
final class PictureLight(plain: AreaLight, surface: SurfaceSampler, picture: Picture)
    extends UnevenLight(plain, surface):

  def radiance(at: ShadingPoint, w: Vec3): Rgb =
    val light = plain.radiance(at, w)
    if light.isBlack then light else light * factor(at)

  protected def factor(at: ShadingPoint): Rgb = picture(at.u, 1f - at.v)

  protected lazy val strength: Float = picture.mean((c, _, _) => c.max)

/** A surface with holes that emits where it has none, as far as it is there.
  *
  * @param alpha how much of the surface is there: rays that meet it find all of that
  */
final class PerforatedLight(
    light: SurfaceLight,
    surface: SurfaceSampler,
    alpha: candela.textures.FloatTexture
) extends UnevenLight(light, surface):
  def radiance(at: ShadingPoint, w: Vec3): Rgb = light.radiance(at, w)

  protected def factor(at: ShadingPoint): Rgb =
    Rgb.White * clamp(alpha(at), 0f, 1f)

  protected def strength: Float = alpha.constant.fold(1f)(clamp(_, 0f, 1f))

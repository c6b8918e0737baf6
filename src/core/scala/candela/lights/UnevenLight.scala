package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, ShadingPoint}
import candela.math.*
import candela.shapes.SurfaceSampler
import candela.textures.{Mapping2D, UvMapping}

/** An area light with spatially varying emission: the emission of `even`, scaled at each point.
  * Points are sampled as for uniform emission.
  *
  * @param even uniform light on the same surface
  */
abstract class UnevenLight(even: SurfaceLight, surface: SurfaceSampler)
    extends ModulatedLight(even):

  /** Scale of the emission at the sampled point. */
  protected def factor(at: ShadingPoint): Rgb

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    even.sample(from, u1, u2, out)
    if out.pdf > 0f then
      // The ray's closest hit is either the sampled point or occludes it
      out.ray.set(from, out.wi, Float.PositiveInfinity)
      if surface.intersectSurface(out.ray, out.hit, out.point) then
        out.radiance.scale(factor(out.point))
      else out.pdf = 0f

  override def emit(
      scene: Ball,
      u1: Float,
      u2: Float,
      v1: Float,
      v2: Float,
      out: EmittedRay
  ): Unit =
    even.emit(scene, u1, u2, v1, v2, out)
    if out.pdf > 0f then
      // Traces back to the point, from so close that no smooth surface occludes it
      val work = out.sample
      val start = out.p + out.direction * (UnevenLight.RelativeOffset * sqrt(surface.area))
      work.ray.set(start, -out.direction, Float.PositiveInfinity)
      if surface.intersectSurface(work.ray, work.hit, work.point) then
        out.radiance = out.radiance * factor(work.point)
      else out.pdf = 0f

object UnevenLight:
  /** Distance from which a ray is traced back, relative to the surface's extent. */
  private val RelativeOffset = 1e-2f

/** An area light textured by an image over u and v (v up).
  *
  * @param plain   light of the same surface with the image's scale as its emission
  * @param mapping of u and v, to an image whose t begins at the bottom
  */
final class PictureLight(
    plain: AreaLight,
    surface: SurfaceSampler,
    picture: Picture,
    mapping: Mapping2D = UvMapping(1f, 1f, 0f, 0f)
) extends UnevenLight(plain, surface):

  def radiance(at: ShadingPoint, w: Vec3): Rgb =
    val light = plain.radiance(at, w)
    if light.isBlack then light else light * factor(at)

  protected def factor(at: ShadingPoint): Rgb =
    val st = mapping(at)
    picture(st.s, 1f - st.t)

  protected def strength: Float = picture.meanOfMax

/** An area light on an alpha-masked surface: its emission is scaled by alpha where it is sampled.
  *
  * @param alpha opacity of the surface
  * @param scalesHits whether it is so, too, where a ray that the mask has not let pass meets it:
  *   pbrt-v4 shows α² of the light
  */
final class PerforatedLight(
    light: SurfaceLight,
    surface: SurfaceSampler,
    alpha: candela.textures.FloatTexture,
    scalesHits: Boolean
) extends UnevenLight(light, surface):
  def radiance(at: ShadingPoint, w: Vec3): Rgb =
    val emitted = light.radiance(at, w)
    if scalesHits then emitted * at.withoutFootprint(factor) else emitted

  protected def factor(at: ShadingPoint): Rgb =
    Rgb.White * clamp(alpha(at), 0f, 1f)

  protected def strength: Float = alpha.constant.fold(1f)(clamp(_, 0f, 1f))

package candela.textures

import candela.geometry.ShadingPoint
import candela.math.*

/** A place in a texture; the unit square holds one copy of an image. */
final class TexCoord(val s: Float, val t: Float)

/** Takes a surface point to its place in a two-dimensional texture. */
abstract class Mapping2D:
  def apply(at: ShadingPoint): TexCoord

/** The surface's own parameters, scaled and moved: s = su·u + du, t = sv·v + dv. */
final class UvMapping(su: Float, sv: Float, du: Float, dv: Float) extends Mapping2D:
  def apply(at: ShadingPoint): TexCoord = TexCoord(su * at.u + du, sv * at.v + dv)

object UvMapping:
  val Identity: UvMapping = UvMapping(1f, 1f, 0f, 0f)

/** Polar coordinates around the texture space's origin: s is the angle from +z over π, t the angle
  * around z, counter-clockwise from +x, over 2π, in [0, 1).
  */
final class SphericalMapping(textureToWorld: Transform) extends Mapping2D:
  private val worldToTexture = textureToWorld.inverse

  def apply(at: ShadingPoint): TexCoord =
    val p = worldToTexture.point(at.p).normalized
    val theta = Math.acos(clamp(p.z, -1f, 1f).toDouble)
    val around = Math.atan2(p.y.toDouble, p.x.toDouble)
    val phi = if around < 0 then around + 2 * Math.PI else around
    TexCoord((theta / Math.PI).toFloat, (phi / (2 * Math.PI)).toFloat)

/** Around the texture space's z axis: s is the angle from −x over 2π, t the height.
  *
  * @param onUnitSphere measure the height after moving the point to the unit sphere, as pbrt-v2 and
  *                     v3 do and v4 does not
  */
final class CylindricalMapping(textureToWorld: Transform, onUnitSphere: Boolean) extends Mapping2D:
  private val worldToTexture = textureToWorld.inverse

  def apply(at: ShadingPoint): TexCoord =
    val inTexture = worldToTexture.point(at.p)
    val p = if onUnitSphere then inTexture.normalized else inTexture
    val around = Math.atan2(p.y.toDouble, p.x.toDouble)
    TexCoord(((Math.PI + around) / (2 * Math.PI)).toFloat, p.z)

/** Along two axes: s = p·axisS + ds, t = p·axisT + dt.
  *
  * @param textureToWorld the identity for pbrt-v2 and v3, which take p in world space
  */
final class PlanarMapping(
    textureToWorld: Transform,
    axisS: Vec3,
    axisT: Vec3,
    ds: Float,
    dt: Float
) extends Mapping2D:
  private val worldToTexture = textureToWorld.inverse

  def apply(at: ShadingPoint): TexCoord =
    val p = worldToTexture.point(at.p)
    TexCoord((p dot axisS) + ds, (p dot axisT) + dt)

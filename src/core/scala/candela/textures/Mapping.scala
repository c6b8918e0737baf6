package candela.textures

import candela.geometry.ShadingPoint
import candela.math.*

/** Texture coordinates; the unit square holds one copy of an image. */
final class TexCoord(val s: Float, val t: Float)

/** Derivatives of texture coordinates by raster position. */
final class TexFootprint(val dsdx: Float, val dtdx: Float, val dsdy: Float, val dtdy: Float)

/** Maps surface points to two-dimensional texture coordinates. */
abstract class Mapping2D:
  def apply(at: ShadingPoint): TexCoord

  /** Derivatives of `apply` over the footprint of `at`. */
  def footprint(at: ShadingPoint): TexFootprint

  /** ∂s/∂u, ∂s/∂v, ∂t/∂u, ∂t/∂v of a map of u and v; else empty. */
  def ofUv: Array[Float] = Array.emptyFloatArray

/** Affine map of the surface's parameters: s = su·u + du, t = sv·v + dv. */
final class UvMapping(su: Float, sv: Float, du: Float, dv: Float) extends Mapping2D:
  def apply(at: ShadingPoint): TexCoord = TexCoord(su * at.u + du, sv * at.v + dv)
  override def ofUv: Array[Float] = Array(su, 0f, 0f, sv)

  def footprint(at: ShadingPoint): TexFootprint =
    TexFootprint(su * at.dudx, sv * at.dvdx, su * at.dudy, sv * at.dvdy)

/** Any affine map of the surface's parameters: s = su·u + sv·v + ds, t = tu·u + tv·v + dt. */
final class AffineUvMapping(
    su: Float,
    sv: Float,
    ds: Float,
    tu: Float,
    tv: Float,
    dt: Float
) extends Mapping2D:
  def apply(at: ShadingPoint): TexCoord =
    TexCoord(su * at.u + sv * at.v + ds, tu * at.u + tv * at.v + dt)

  override def ofUv: Array[Float] = Array(su, sv, tu, tv)

  def footprint(at: ShadingPoint): TexFootprint =
    TexFootprint(
      su * at.dudx + sv * at.dvdx,
      tu * at.dudx + tv * at.dvdx,
      su * at.dudy + sv * at.dvdy,
      tu * at.dudy + tv * at.dvdy
    )

/** The same of a second set of parameters. */
final class SecondUvMapping(
    su: Float,
    sv: Float,
    ds: Float,
    tu: Float,
    tv: Float,
    dt: Float
) extends Mapping2D:
  def apply(at: ShadingPoint): TexCoord =
    TexCoord(su * at.u2 + sv * at.v2 + ds, tu * at.u2 + tv * at.v2 + dt)

  /** Unknown: only textures that are not filtered have a second set. */
  def footprint(at: ShadingPoint): TexFootprint = Mapping2D.Unknown

object AffineUvMapping:
  /** @param rows   s and t by u, v and 1; without them, u and v as they are
    * @param second whether of the second set of u and v
    */
  def of(rows: Array[Float], second: Boolean = false): Mapping2D = rows match
    case Array(su, sv, ds, tu, tv, dt) =>
      if second then SecondUvMapping(su, sv, ds, tu, tv, dt)
      else AffineUvMapping(su, sv, ds, tu, tv, dt)
    case _ =>
      if second then SecondUvMapping(1f, 0f, 0f, 0f, 1f, 0f) else UvMapping(1f, 1f, 0f, 0f)

/** Spherical mapping about the texture space's origin: s is the angle from +z over π, t the angle
  * around z, counter-clockwise from +x, over 2π, in [0, 1).
  */
final class SphericalMapping(textureToWorld: Transform) extends Mapping2D:
  private val worldToTexture = textureToWorld.inverse

  def apply(at: ShadingPoint): TexCoord =
    val p = worldToTexture.point(at.p).normalized
    val theta = Math.acos(clamp(p.z, -1f, 1f).toDouble)
    val azimuth = Math.atan2(p.y.toDouble, p.x.toDouble)
    val phi = if azimuth < 0 then azimuth + 2 * Math.PI else azimuth
    TexCoord((theta / Math.PI).toFloat, (phi / (2 * Math.PI)).toFloat)

  def footprint(at: ShadingPoint): TexFootprint =
    val p = worldToTexture.point(at.p)
    val r2 = square(p.x) + square(p.y)
    val r = sqrt(r2)
    // ∂θ/∂p over π, and ∂φ/∂p over 2π; 0 at the poles, where they are infinite
    val d = if r > 0f then 1f / (Pi * (r2 + square(p.z))) else 0f
    val ds = Vec3(p.x * p.z * d / r, p.y * p.z * d / r, -r * d)
    val dt = Mapping2D.angleGradient(p)
    if r > 0f then Mapping2D.along(worldToTexture, ds, dt, at) else Mapping2D.Unknown

/** Cylindrical mapping about the texture space's z axis: s is the angle from −x over 2π, t the
  * height.
  *
  * @param onUnitSphere whether to project the point onto the unit sphere before measuring its
  *   height, as pbrt-v2 and v3 do and v4 does not
  */
final class CylindricalMapping(textureToWorld: Transform, onUnitSphere: Boolean) extends Mapping2D:
  private val worldToTexture = textureToWorld.inverse

  def apply(at: ShadingPoint): TexCoord =
    val inTexture = worldToTexture.point(at.p)
    val p = if onUnitSphere then inTexture.normalized else inTexture
    val azimuth = Math.atan2(p.y.toDouble, p.x.toDouble)
    TexCoord(((Math.PI + azimuth) / (2 * Math.PI)).toFloat, p.z)

  def footprint(at: ShadingPoint): TexFootprint =
    val p = worldToTexture.point(at.p)
    val length = p.length
    val dt =
      if onUnitSphere then (Vec3.Z - p * (p.z / square(length))) * (1f / length) else Vec3.Z
    if p.x == 0f && p.y == 0f then Mapping2D.Unknown
    else Mapping2D.along(worldToTexture, Mapping2D.angleGradient(p), dt, at)

/** Planar mapping: s = p·axisS + ds, t = p·axisT + dt.
  *
  * @param textureToWorld the identity for pbrt-v2 and v3, which use p in world space
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

  def footprint(at: ShadingPoint): TexFootprint =
    Mapping2D.along(worldToTexture, axisS, axisT, at)

private object Mapping2D:
  val Unknown: TexFootprint = TexFootprint(0f, 0f, 0f, 0f)

  /** Gradient of the angle around z, over 2π. */
  def angleGradient(p: Vec3): Vec3 =
    val d = 1f / (2f * Pi * (square(p.x) + square(p.y)))
    Vec3(-p.y * d, p.x * d, 0f)

  /** Footprint of coordinates with these gradients in texture space. */
  def along(worldToTexture: Transform, ds: Vec3, dt: Vec3, at: ShadingPoint): TexFootprint =
    val px = worldToTexture.vector(at.dpdx)
    val py = worldToTexture.vector(at.dpdy)
    TexFootprint(ds dot px, dt dot px, ds dot py, dt dot py)

/** Maps points to three-dimensional texture coordinates.
  *
  * @param worldToTexture in pbrt-v2 and v3 the statement's transform itself, in v4 its inverse
  * @param far what to add to the coordinates in Double, where Floats are coarse
  */
final class Mapping3D(worldToTexture: Transform, val far: Position = Position.Origin):
  def apply(at: ShadingPoint): Vec3 = worldToTexture.point(at.p)

  /** Squared length of the longer step to a neighbouring raster position. */
  def footprintSquared(at: ShadingPoint): Float =
    Math.max(
      worldToTexture.vector(at.dpdx).lengthSquared,
      worldToTexture.vector(at.dpdy).lengthSquared
    )

  /** Largest step to a neighbouring raster position, per axis. */
  def extent(at: ShadingPoint): Vec3 =
    val x = worldToTexture.vector(at.dpdx)
    val y = worldToTexture.vector(at.dpdy)
    Vec3(
      Math.max(abs(x.x), abs(y.x)),
      Math.max(abs(x.y), abs(y.y)),
      Math.max(abs(x.z), abs(y.z))
    )

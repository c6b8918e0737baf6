package candela.bsdf

import candela.geometry.{Frame, ShadingPoint}
import candela.math.*
import candela.textures.{FloatTexture, Mapping2D, MipLevel, Slopes}

/** Base of materials that perturb the shading frame at each point. */
abstract class DisplacedMaterial(inner: Material) extends WrappedMaterial(inner):
  override val isConstant: Boolean = false

/** Bump mapping: perturbs the shading frame as if the surface were displaced along its normal.
  *
  * @param height   displacement, in world units
  * @param smallest step in u and v where the ray footprint is unknown
  *
  * Source: Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978.
  */
final class BumpMaterial(inner: Material, height: FloatTexture, smallest: Float)
    extends DisplacedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf =
    val p = at.p.toVec3
    val u = at.u
    val v = at.v
    val baseHeight = height(at)
    // Half a sample spacing: finer detail would alias.
    val du = step(at.dudx, at.dudy)
    at.p = p + at.tangentU * du
    at.u = u + du
    val slopeU = (height(at) - baseHeight) / du
    val dv = step(at.dvdx, at.dvdy)
    at.p = p + at.tangentV * dv
    at.u = u
    at.v = v + dv
    val slopeV = (height(at) - baseHeight) / dv
    at.p = p
    at.v = v
    val bumpNormal = at.frame.n * at.bumpSide
    val dpdu = at.tangentU + bumpNormal * slopeU + at.bendU * baseHeight
    val dpdv = at.tangentV + bumpNormal * slopeV + at.bendV * baseHeight
    val n = dpdu cross dpdv
    if n.lengthSquared > 0f then
      at.frame.set(Frame.along(n.normalized.facing(at.geometricNormal), dpdu))
    inner.bsdf(at)

  private def step(dx: Float, dy: Float): Float =
    val d = 0.5f * (Math.abs(dx) + Math.abs(dy))
    if d == 0f then smallest else d

/** Bump mapping as in Mitsuba: by the height's derivatives at the point, where the texture knows
  * them, and along the tangents of the surface, made perpendicular to its shading normal.
  *
  * @param height displacement, in world units
  * @param step   in u and v, where derivatives are differences
  */
final class SlopeBumpMaterial(inner: Material, height: FloatTexture, step: Float)
    extends DisplacedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf =
    val slopes = height.slopes(at) match
      case null => differences(at)
      case known: Slopes => known
    val n = at.frame.n.toVec3
    val u = at.dpdu.toVec3
    val v = at.dpdv.toVec3
    val raisedU = u + n * (slopes.byU - (n dot u))
    val raisedV = v + n * (slopes.byV - (n dot v))
    val raised = raisedU cross raisedV
    if raised.lengthSquared > 0f then
      at.frame.set(Frame.along(raised.normalized.facing(at.geometricNormal), u))
    inner.bsdf(at)

  private def differences(at: ShadingPoint): Slopes =
    val baseHeight = height(at)
    val u = at.u
    val v = at.v
    at.u = u + step
    val byU = (height(at) - baseHeight) / step
    at.u = u
    at.v = v + step
    val byV = (height(at) - baseHeight) / step
    at.v = v
    Slopes(byU, byV)

/** Normal mapping (pbrt-v4): red, green and blue in [0, 1] encode the components along u, v and the
  * normal in [−1, 1].
  *
  * @param mapping to the image, whose t begins at the bottom
  * @param faces   whether normals are kept on the side of the geometric one
  * @param scale   of the components along u and v
  * @param sides   whether the component along v follows the tangent of v, which mirrored u and v
  *                turn over
  */
final class NormalMapMaterial(
    inner: Material,
    map: MipLevel,
    mapping: Mapping2D,
    faces: Boolean = true,
    scale: Float = 1f,
    sides: Boolean = false
) extends DisplacedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf =
    val texCoord = mapping(at)
    val c = map.bilinear(texCoord.s, 1f - texCoord.t)
    val frame = Frame.along(at.frame.n, at.tangentU)
    val turn = if sides && (frame.t dot at.tangentV) < 0f then -scale else scale
    val n = frame.toWorld(Vec3((2f * c.r - 1f) * scale, (2f * c.g - 1f) * turn, 2f * c.b - 1f))
    if n.lengthSquared > 0f then
      val unit = n.normalized
      val shadingNormal = if faces then unit.facing(at.geometricNormal) else unit
      at.frame.set(Frame.along(shadingNormal, at.tangentU))
    inner.bsdf(at)

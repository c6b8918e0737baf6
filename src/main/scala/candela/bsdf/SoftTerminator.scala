package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Bumps or a normal map as Mitsuba renders them.
  *
  * Light that would come from the other side of the unperturbed surface is blocked, and light close
  * to it fades as microfacets shadow each other. Normals that face away are mirrored.
  *
  * @param relief perturbs the shading frame of `inner`
  *
  * Source: Estevez, Lecocq and Stein, "A Microfacet-Based Shadowing Function to Solve the Bump
  * Terminator Problem", Ray Tracing Gems, 2019.
  */
final class SoftTerminatorMaterial(inner: Material, relief: Material => Material, shadows: Boolean)
    extends DisplacedMaterial(inner):
  private val perturbed = relief(NormalsOnly)

  def bsdf(at: ShadingPoint): Bsdf =
    val flat = at.frame.toFrame
    val _ = perturbed.bsdf(at)
    val n = flat.toLocal(at.frame.n.toVec3)
    val sheared = Math.max(0f, 1f - n.z * n.z) / Math.max(n.z * n.z, 1e-8f)
    val alpha2 = if shadows then Math.min(0.125f * sheared, 1f) else 0f
    val base = at.frame.toLocal(flat.n)
    SoftTerminator(inner.bsdf(at), base, alpha2)

  /** Black from behind, by the side of the surface that `wo` is on. */
  def oneSided: SoftTerminatorMaterial =
    SoftTerminatorMaterial(OneSidedMaterial(inner), relief, shadows)

  /** Stands for the inner material while the frame is perturbed. */
  private object NormalsOnly extends Material:
    private val nothing = Lambert(Rgb.Black)
    def bsdf(at: ShadingPoint): Bsdf = nothing
    override def isAnisotropic: Boolean = inner.isAnisotropic
    override def isDirected: Boolean = inner.isDirected

/** @param base   normal of the unperturbed surface, in the perturbed frame
  * @param alpha2 square of the roughness that shadows
  */
final class SoftTerminator(inner: Bsdf, base: Vec3, alpha2: Float) extends LeanBsdf:

  /** Whether the perturbed normal faces away from `wo`. Then its image about `base` replaces it. */
  private def isAway(wo: Vec3): Boolean = (wo dot base) * wo.z <= 0f

  /** Half a turn about `base`; its own inverse. */
  private def turned(w: Vec3): Vec3 = base * (2f * (w dot base)) - w

  /** Light that passes the microfacets, for `wi` relative to the perturbed normal. */
  private def passed(wi: Vec3): Float =
    val cos = wi dot base
    if cos * wi.z <= 0f then 0f
    else if alpha2 == 0f then 1f
    else
      val tan2 = Math.max(0f, 1f - cos * cos) / (cos * cos)
      2f / (1f + sqrt(1f + alpha2 * tan2))

  def f(wo: Vec3, wi: Vec3): Rgb =
    if !isAway(wo) then facing(wo, wi)
    else
      // The cosine is to be that to the turned normal
      val there = turned(wi)
      val cosine = Math.abs(wi.z)
      if cosine < Hemisphere.Horizon then Rgb.Black
      else facing(turned(wo), there) * (Math.abs(there.z) / cosine)

  private def facing(wo: Vec3, wi: Vec3): Rgb =
    val part = passed(wi)
    if part == 0f then Rgb.Black else inner.f(wo, wi) * part

  def pdf(wo: Vec3, wi: Vec3): Float =
    if isAway(wo) then facingPdf(turned(wo), turned(wi)) else facingPdf(wo, wi)

  private def facingPdf(wo: Vec3, wi: Vec3): Float =
    if passed(wi) == 0f then 0f else inner.pdf(wo, wi)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val away = isAway(wo)
    inner.draw(if away then turned(wo) else wo, choice, u1, u2, out)
    val wi = out.wi.toVec3
    val part = passed(wi)
    if part == 0f then out.absorb()
    else
      val there = if away then turned(wi) else wi
      out.set(there, out.weight * part, out.pdf, out.isSpecular, out.eta)

  def isSpecular: Boolean = inner.isSpecular

  /** Through the perturbed surface, where its normals are turned. */
  def isTransmissive: Boolean = inner.isTransmissive || base.z < 1f
  override def isDiffuse: Boolean = inner.isDiffuse
  override def isReciprocal: Boolean = false
  override def regularized: Bsdf = SoftTerminator(inner.regularized, base, alpha2)
  override def isDispersive: Boolean = inner.isDispersive

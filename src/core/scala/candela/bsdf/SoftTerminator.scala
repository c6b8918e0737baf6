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
  * @param turns  whether normals that face away are mirrored; else the surface is black there
  *
  * Source: Estevez, Lecocq and Stein, "A Microfacet-Based Shadowing Function to Solve the Bump
  * Terminator Problem", Ray Tracing Gems, 2019.
  */
final class SoftTerminatorMaterial(
    inner: Material,
    relief: Material => Material,
    shadows: Boolean,
    turns: Boolean = true
) extends DisplacedMaterial(inner):
  private val perturbed = relief(NormalsOnly)

  def bsdf(at: ShadingPoint): Bsdf =
    val flat = at.frame.toFrame
    val _ = perturbed.bsdf(at)
    val n = flat.toLocal(at.frame.n.toVec3)
    val sheared = Math.max(0f, 1f - n.z * n.z) / Math.max(n.z * n.z, 1e-8f)
    val alpha2 = if shadows then Math.min(0.125f * sheared, 1f) else 0f
    val base = at.frame.toLocal(flat.n)
    SoftTerminator(inner.bsdf(at), base, alpha2, turns, inner.isDirected)

  /** Light samples of Mitsuba don't pass a pane whose normals are perturbed. */
  override def flags: MaterialFlags =
    inner.flags.minus(MaterialFlags.Pane) | MaterialFlags.OwnFrame

  /** By the side of the surface that `wo` is on. */
  override def oneSided: Material =
    if isInterface then this
    else SoftTerminatorMaterial(OneSidedMaterial(inner), relief, shadows, turns)

  /** Stands for the inner material while the frame is perturbed. */
  private object NormalsOnly extends Material:
    private val nothing = Lambert(Rgb.Black)
    def bsdf(at: ShadingPoint): Bsdf = nothing
    override def isAnisotropic: Boolean = inner.isAnisotropic
    override def isDirected: Boolean = inner.isDirected

/** @param base       normal of the unperturbed surface, in the perturbed frame
  * @param alpha2     square of the roughness that shadows
  * @param turns      as in [[SoftTerminatorMaterial]]
  * @param isDirected whether `inner` tells the two directions of its tangent apart
  */
final class SoftTerminator(
    inner: Bsdf,
    base: Vec3,
    alpha2: Float,
    turns: Boolean = true,
    isDirected: Boolean = false
) extends LeanBsdf:

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

  /** `w` for `inner`, whose tangent is not turned together with its normal, and back. */
  private def toInner(w: Vec3, isTurned: Boolean): Vec3 =
    if isTurned && isDirected then Vec3(-w.x, -w.y, w.z) else w

  def f(wo: Vec3, wi: Vec3): Rgb =
    if !isAway(wo) then facing(wo, wi, isTurned = false)
    else if !turns then Rgb.Black
    else
      // The cosine is to be that to the turned normal
      val turnedWi = turned(wi)
      val cosine = Math.abs(wi.z)
      if cosine < Hemisphere.Horizon then Rgb.Black
      else facing(turned(wo), turnedWi, isTurned = true) * (Math.abs(turnedWi.z) / cosine)

  private def facing(wo: Vec3, wi: Vec3, isTurned: Boolean): Rgb =
    val shadowing = passed(wi)
    if shadowing == 0f then Rgb.Black
    else inner.f(toInner(wo, isTurned), toInner(wi, isTurned)) * shadowing

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !isAway(wo) then facingPdf(wo, wi, isTurned = false)
    else if !turns then 0f
    else facingPdf(turned(wo), turned(wi), isTurned = true)

  private def facingPdf(wo: Vec3, wi: Vec3, isTurned: Boolean): Float =
    if passed(wi) == 0f then 0f else inner.pdf(toInner(wo, isTurned), toInner(wi, isTurned))

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val isTurned = isAway(wo)
    inner.draw(toInner(if isTurned then turned(wo) else wo, isTurned), choice, u1, u2, out)
    val wi = toInner(out.wi.toVec3, isTurned)
    val shadowing = passed(wi)
    if shadowing == 0f || isTurned && !turns then out.absorb()
    else
      out.wi.set(if isTurned then turned(wi) else wi)
      out.scale(shadowing)

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    val isTurned = isAway(wo)
    val s = inner.sampleSpecular(toInner(if isTurned then turned(wo) else wo, isTurned), choice)
    val wi = toInner(s.wi, isTurned)
    val shadowing = passed(wi)
    if shadowing == 0f || isTurned && !turns then BsdfSample.Absorbed
    else
      val outerWi = if isTurned then turned(wi) else wi
      BsdfSample(outerWi, s.weight * shadowing, s.pdf, s.isSpecular, s.eta)

  val flags: BsdfFlags =
    val changed = inner.flags.minus(BsdfFlags.Pane) | BsdfFlags.NonReciprocal
    // Through the perturbed surface, where its normals are turned
    if base.z < 1f then changed | BsdfFlags.Transmissive else changed

  override def diffuseReflectance(wo: Vec3): Rgb = inner.diffuseReflectance(wo)
  override def regularized: Bsdf =
    SoftTerminator(inner.regularized, base, alpha2, turns, isDirected)

package candela.bsdf

import candela.color.Rgb
import candela.geometry.{Frame, ShadingPoint}
import candela.math.*

/** A material that perturbs normals for itself alone: what it is blended with, or what is on the
  * other side, keeps the shading frame of the surface, as in Mitsuba.
  */
final class FramedMaterial(inner: Material) extends DisplacedMaterial(inner):
  override def isDirected: Boolean = true
  override def flags: MaterialFlags = inner.flags.minus(MaterialFlags.OwnFrame)

  def bsdf(at: ShadingPoint): Bsdf =
    val outer = at.frame.toFrame
    val scattered = inner.bsdf(at)
    val perturbed = at.frame.toFrame
    at.frame.set(outer)
    Framed(
      scattered,
      Frame(outer.toLocal(perturbed.s), outer.toLocal(perturbed.t), outer.toLocal(perturbed.n))
    )

object FramedMaterial:
  /** Where `inner` perturbs normals as Mitsuba does. */
  def of(inner: Material): Material =
    if inner.flags.hasAny(MaterialFlags.OwnFrame) then FramedMaterial(inner) else inner

/** `inner` in a frame of its own. */
final class Framed(inner: Bsdf, frame: Frame) extends LeanBsdf:
  def normal: Vec3 = frame.n

  /** The cosine is to be that to the normal of `inner`. */
  def f(wo: Vec3, wi: Vec3): Rgb =
    val innerWi = frame.toLocal(wi)
    val cosine = Math.abs(wi.z)
    if cosine < Hemisphere.Horizon then Rgb.Black
    else inner.f(frame.toLocal(wo), innerWi) * (Math.abs(innerWi.z) / cosine)

  def pdf(wo: Vec3, wi: Vec3): Float = inner.pdf(frame.toLocal(wo), frame.toLocal(wi))

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    inner.draw(frame.toLocal(wo), choice, u1, u2, out)
    out.wi.set(frame.toWorld(out.wi.toVec3))

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    val s = inner.sampleSpecular(frame.toLocal(wo), choice)
    BsdfSample(frame.toWorld(s.wi), s.weight, s.pdf, s.isSpecular, s.eta)

  def flags: BsdfFlags = inner.flags | BsdfFlags.NonReciprocal
  override def straight(wo: Vec3): Rgb = inner.straight(frame.toLocal(wo))
  override def diffuseReflectance(wo: Vec3): Rgb = inner.diffuseReflectance(frame.toLocal(wo))
  override def regularized: Bsdf = Framed(inner.regularized, frame)

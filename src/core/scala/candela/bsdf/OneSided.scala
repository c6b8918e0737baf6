package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** A surface that is black from behind, as Mitsuba's are. */
private[bsdf] final class OneSidedMaterial(inner: Material) extends WrappedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf = OneSided(inner.bsdf(at))
  override def flags: MaterialFlags = inner.flags.minus(MaterialFlags.Pane)

/** Scatters only between directions above the surface. */
final class OneSided(inner: Bsdf) extends LeanBsdf:
  private def isAbove(wo: Vec3, wi: Vec3) = wo.z > 0f && wi.z > 0f

  def f(wo: Vec3, wi: Vec3): Rgb = if isAbove(wo, wi) then inner.f(wo, wi) else Rgb.Black
  def pdf(wo: Vec3, wi: Vec3): Float = if isAbove(wo, wi) then inner.pdf(wo, wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    if wo.z > 0f then
      inner.draw(wo, choice, u1, u2, out)
      if !(out.wi.z > 0f) then out.absorb()
    else out.absorb()

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    if wo.z > 0f then inner.sampleSpecular(wo, choice) else BsdfSample.Absorbed

  def flags: BsdfFlags = inner.flags.minus(BsdfFlags.Transmissive | BsdfFlags.Pane)
  override def diffuseReflectance(wo: Vec3): Rgb = inner.diffuseReflectance(wo)
  override def regularized: Bsdf = OneSided(inner.regularized)

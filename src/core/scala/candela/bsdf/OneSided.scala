package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** A surface that is black from behind, as Mitsuba's are. */
final class OneSidedMaterial(inner: Material) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = OneSided(inner.bsdf(at))
  override def isConstant: Boolean = inner.isConstant
  override def isAnisotropic: Boolean = inner.isAnisotropic
  override def isDirected: Boolean = inner.isDirected
  override def isDispersive: Boolean = inner.isDispersive
  override def isSubsurface: Boolean = inner.isSubsurface
  override def bssrdf(at: ShadingPoint): Bssrdf | Null = inner.bssrdf(at)

object OneSidedMaterial:
  def of(inner: Material): Material = inner match
    case InterfaceMaterial => inner
    case relief: SoftTerminatorMaterial => relief.oneSided
    case _ => new OneSidedMaterial(inner).folded

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

  def isSpecular: Boolean = inner.isSpecular
  def isTransmissive: Boolean = false
  override def isDiffuse: Boolean = inner.isDiffuse
  override def isReciprocal: Boolean = inner.isReciprocal
  override def regularized: Bsdf = OneSided(inner.regularized)
  override def isDispersive: Boolean = inner.isDispersive

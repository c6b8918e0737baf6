package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** A surface that looks like `back` from behind, as if that were in front, as in Mitsuba. */
final class TwoSidedMaterial(front: Material, back: Material) extends JoinedMaterial(front, back):
  def bsdf(at: ShadingPoint): Bsdf =
    val facing = front.bsdf(at)
    TwoSided(facing, if back eq front then facing else back.bsdf(at))
  override def flags: MaterialFlags = super.flags.minus(MaterialFlags.Pane)

/** Reflects by `front` above the surface and by `back`, mirrored, below it. */
final class TwoSided(front: Bsdf, back: Bsdf) extends LeanBsdf:
  def f(wo: Vec3, wi: Vec3): Rgb =
    if !Hemisphere.isSameSide(wo, wi) then Rgb.Black
    else if wo.z > 0f then front.f(wo, wi)
    else back.f(Hemisphere.flipped(wo), Hemisphere.flipped(wi))

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !Hemisphere.isSameSide(wo, wi) then 0f
    else if wo.z > 0f then front.pdf(wo, wi)
    else back.pdf(Hemisphere.flipped(wo), Hemisphere.flipped(wi))

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val side = if wo.z > 0f then front else back
    side.draw(Hemisphere.above(wo), choice, u1, u2, out)
    val upper = out.wi.toVec3
    if upper.z > 0f then out.wi.set(Hemisphere.seenFrom(wo, upper)) else out.absorb()

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    val s = (if wo.z > 0f then front else back).sampleSpecular(Hemisphere.above(wo), choice)
    BsdfSample(Hemisphere.seenFrom(wo, s.wi), s.weight, s.pdf, s.isSpecular, s.eta)

  val flags: BsdfFlags =
    (front.flags | back.flags).minus(BsdfFlags.Transmissive | BsdfFlags.Pane)
  override def diffuseReflectance(wo: Vec3): Rgb =
    (if wo.z > 0f then front else back).diffuseReflectance(Hemisphere.above(wo))
  override def regularized: Bsdf =
    val facing = front.regularized
    TwoSided(facing, if back eq front then facing else back.regularized)

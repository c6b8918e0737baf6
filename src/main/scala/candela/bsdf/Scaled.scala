package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** Scatters `scale` times what another does, in the same directions. */
final class Scaled(inner: Bsdf, scale: Rgb) extends WrappedBsdf(inner):
  override def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi) * scale

  override def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val s = inner.sample(wo, choice, u1, u2)
    BsdfSample(s.wi, s.weight * scale, s.pdf, s.isSpecular, s.eta)

  override def regularized: Bsdf = Scaled(inner.regularized, scale)
  override def atWavelength(nm: Float): Bsdf = Scaled(inner.atWavelength(nm), scale)

/** Sends to the other side of the surface what `reflection` would send to this one.
  *
  * Source: PBRT 2nd ed., §8.1 ("BRDFToBTDF").
  */
final class SentThrough(reflection: Bsdf) extends WrappedBsdf(reflection):
  override def f(wo: Vec3, wi: Vec3): Rgb = reflection.f(wo, Hemisphere.flipped(wi))
  override def pdf(wo: Vec3, wi: Vec3): Float = reflection.pdf(wo, Hemisphere.flipped(wi))

  override def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val s = reflection.sample(wo, choice, u1, u2)
    BsdfSample(Hemisphere.flipped(s.wi), s.weight, s.pdf, s.isSpecular, s.eta)

  override def isTransmissive: Boolean = true
  override def regularized: Bsdf = SentThrough(reflection.regularized)
  override def atWavelength(nm: Float): Bsdf = SentThrough(reflection.atWavelength(nm))

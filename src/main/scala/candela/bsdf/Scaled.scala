package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** Scatters `scale` times what another does, in the same directions. */
final class Scaled(inner: Bsdf, scale: Rgb) extends Bsdf:
  def f(wo: Vec3, wi: Vec3): Rgb = inner.f(wo, wi) * scale
  def pdf(wo: Vec3, wi: Vec3): Float = inner.pdf(wo, wi)

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val s = inner.sample(wo, choice, u1, u2)
    BsdfSample(s.wi, s.weight * scale, s.pdf, s.isSpecular, s.eta)

  def isSpecular: Boolean = inner.isSpecular
  def isTransmissive: Boolean = inner.isTransmissive

/** Sends to the other side of the surface what `reflection` would send to this one.
  *
  * Source: PBRT 2nd ed., §8.1 ("BRDFToBTDF").
  */
final class SentThrough(reflection: Bsdf) extends Bsdf:
  def f(wo: Vec3, wi: Vec3): Rgb = reflection.f(wo, Hemisphere.flipped(wi))
  def pdf(wo: Vec3, wi: Vec3): Float = reflection.pdf(wo, Hemisphere.flipped(wi))

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val s = reflection.sample(wo, choice, u1, u2)
    BsdfSample(Hemisphere.flipped(s.wi), s.weight, s.pdf, s.isSpecular, s.eta)

  def isSpecular: Boolean = reflection.isSpecular
  def isTransmissive: Boolean = true

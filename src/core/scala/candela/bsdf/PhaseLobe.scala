package candela.bsdf

import candela.color.Rgb
import candela.math.Vec3
import candela.sampling.PhaseFunction

/** A phase function as the BSDF of a vertex without a surface, whose cosines are 1. */
final class PhaseLobe(phase: PhaseFunction) extends Bsdf:
  def f(wo: Vec3, wi: Vec3): Rgb = Rgb.gray(phase.value(wo, wi))
  def pdf(wo: Vec3, wi: Vec3): Float = phase.value(wo, wi)
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val wi = phase.sample(wo, u1, u2)
    BsdfSample(wi, Rgb.White, phase.value(wo, wi), isSpecular = false)
  def flags: BsdfFlags = BsdfFlags.Glossy | BsdfFlags.Transmissive

package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** Reflection with cosine-weighted sampling, for lack of a better pdf; the same on both sides. */
abstract class CosineSampled extends LeanBsdf:

  /** The BSDF value in sr⁻¹, for directions in the same hemisphere. */
  protected def value(wo: Vec3, wi: Vec3): Rgb

  final def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isSameSide(wo, wi) then value(wo, wi) else Rgb.Black

  final def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isSameSide(wo, wi) then Hemisphere.cosinePdf(wi) else 0f

  final override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi = Hemisphere.cosineSample(wo, u1, u2)
    if !Hemisphere.isSameSide(wo, wi) then out.absorb()
    else out.set(wi, value(wo, wi) * Pi, Hemisphere.cosinePdf(wi), isSpecular = false)

  final def flags: BsdfFlags = BsdfFlags.Diffuse

package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.sampling.{SampleHash, Warp}

/** A diffuse surface that reflects as much light as `inner` reflects, for each direction of view.
  *
  * @param transmits whether it also reflects what `inner` transmits
  */
final class DiffuseEquivalent(inner: Material, transmits: Boolean) extends WrappedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf =
    DiffuseEquivalent.Lobe(inner.bsdf(at), DiffuseEquivalent.hash(at.p), transmits)
  override val isConstant: Boolean = false
  override def flags: MaterialFlags = inner.flags.mask(MaterialFlags.Dispersive)

object DiffuseEquivalent:
  private def bits(f: Float) = java.lang.Float.floatToRawIntBits(f) & 0xffffffffL

  private def hash(p: Vec3) =
    SampleHash.mix64(bits(p.x) << 32 | bits(p.y)) ^ SampleHash.mix64(bits(p.z))

  /** @param place hash of the position, from which the random numbers of the estimated albedo
    *              follow
    */
  private final class Lobe(inner: Bsdf, place: Long, transmits: Boolean) extends Bsdf:

    /** Estimated by one sample, which is right on average, as paths use it once. */
    private def albedo(wo: Vec3): Rgb =
      val first = SampleHash.mix64(place ^ (bits(wo.x) << 32 | bits(wo.y)))
      val second = SampleHash.mix64(first + SampleHash.Step)
      val third = SampleHash.mix64(second + SampleHash.Step)
      def unit(hash: Long) = SampleHash.toUnit((hash >>> 32).toInt)
      val drawn = inner.sample(wo, unit(first), unit(second), unit(third))
      if transmits || isReflection(wo, drawn.wi) then drawn.weight else Rgb.Black

    private def isReflection(wo: Vec3, wi: Vec3) = wo.z * wi.z > 0f

    def f(wo: Vec3, wi: Vec3): Rgb = if isReflection(wo, wi) then albedo(wo) * InvPi else Rgb.Black

    def pdf(wo: Vec3, wi: Vec3): Float =
      if isReflection(wo, wi) then Warp.cosineHemispherePdf(Math.abs(wi.z)) else 0f

    def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
      val w = Warp.cosineHemisphere(u1, u2)
      val wi = if wo.z < 0f then Vec3(w.x, w.y, -w.z) else w
      val weight = albedo(wo)
      if weight.isBlack then BsdfSample.Absorbed
      else BsdfSample(wi, weight, pdf(wo, wi), isSpecular = false)

    def flags: BsdfFlags =
      BsdfFlags.Diffuse | BsdfFlags.NonReciprocal | inner.flags.mask(BsdfFlags.Dispersive)

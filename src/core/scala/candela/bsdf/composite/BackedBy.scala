package candela.bsdf.composite

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, BsdfSample, LeanBsdf}
import candela.color.Rgb
import candela.math.Vec3

/** A sum of lobes of which only one is not black from behind. There it alone is sampled.
  *
  * @param whole  all lobes
  * @param behind the one that is not black from behind, as part of `whole`
  */
final class BackedBy(whole: Bsdf, behind: Bsdf) extends LeanBsdf:
  private def side(wo: Vec3): Bsdf = if wo.z < 0f then behind else whole

  def f(wo: Vec3, wi: Vec3): Rgb = side(wo).f(wo, wi)
  def pdf(wo: Vec3, wi: Vec3): Float = side(wo).pdf(wo, wi)
  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    side(wo).draw(wo, choice, u1, u2, out)
  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    side(wo).sampleSpecular(wo, choice)

  val flags: BsdfFlags = whole.flags | behind.flags
  override def straight(wo: Vec3): Rgb = side(wo).straight(wo)
  override def regularized: Bsdf = BackedBy(whole.regularized, behind.regularized)

package candela.bsdf.composite

import candela.bsdf.{
  Bsdf, BsdfFlags, BsdfSample, DiffuseTransmission, Fresnel, Hemisphere, Lobes, Material,
  ReflectanceCurve,
  SentThrough, WrappedBsdf
}
import candela.bsdf.microfacet.MicrofacetReflection
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.Textured

/** Mitsuba's `principledthin`: a sheet without thickness, the same on both sides. Light that it
  * transmits is spread by microfacets, but not bent.
  *
  * Sources: Burley 2015 (see [[DisneyDiffuse]]), figure 15; Mitsuba 3, "principledthin".
  */
final class PrincipledThinMaterial(p: DisneyParameters) extends Material, Textured(p):

  def bsdf(at: ShadingPoint): Bsdf =
    val color = p.color.albedo(at)
    val hue = Principled.hue(color)
    val eta = p.eta(at)
    val roughness = p.roughness(at)
    val clear = p.transmission(at)
    val passing = 0.5f * p.diffTrans(at)
    val frontShare = (1f - clear) * (1f - passing)

    val lobes = Lobes.Builder()
    val flat = p.flatness(at)
    val base = color * frontShare
    val cloth = Principled.tinted(hue, p.sheenTint(at)) * (p.sheen(at) * frontShare)
    lobes.add(
      DisneyDiffuse(base * (1f - flat), base * flat, base * (1f - flat), cloth, roughness),
      base.max + 0.2f * cloth.max
    )
    val through = color * ((1f - clear) * passing)
    lobes.add(DiffuseTransmission(Rgb.Black, through), through.max)

    val anisotropic = p.anisotropic(at)
    val curve = ThinReflectance(hue, p.specularTint(at), eta)
    lobes.add(
      MicrofacetReflection(Principled.facets(roughness, anisotropic), curve, Rgb.gray(clear)),
      Math.max(Schlick.normal(eta), 0.04f) * clear
    )
    val spread = Principled.facets((0.65f * eta - 0.35f) * roughness, anisotropic)
    val passed = color * clear
    lobes.add(
      FacetsBetween(SentThrough(MicrofacetReflection(spread, ThinTransmittance(eta), passed))),
      passed.max
    )
    lobes.result

/** Fresnel reflectance of a sheet, the same from both sides: a dielectric's, partly tinted by
  * Schlick's approximation.
  */
final class ThinReflectance(hue: Rgb, tint: Float, eta: Float) extends ReflectanceCurve:
  private val front = PrincipledReflectance(Rgb.Black, hue, 0f, tint, eta, 0f)
  def apply(cosTheta: Float): Rgb = front(Math.abs(cosTheta))

/** What a sheet does not reflect. */
private final class ThinTransmittance(eta: Float) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb.gray(1f - Fresnel.dielectric(Math.abs(cosTheta), eta))

/** Transmission to directions behind the microfacet that spreads the light; Mitsuba leaves out
  * others.
  */
private final class FacetsBetween(inner: Bsdf) extends WrappedBsdf(inner):
  private def isBehind(wo: Vec3, wi: Vec3): Boolean =
    val i = Hemisphere.above(wi)
    (Hemisphere.flipped(i) dot (Hemisphere.above(wo) + i)) < 0f

  override def flags: BsdfFlags = inner.flags | BsdfFlags.NonReciprocal
  override def f(wo: Vec3, wi: Vec3): Rgb = if isBehind(wo, wi) then inner.f(wo, wi) else Rgb.Black
  override def pdf(wo: Vec3, wi: Vec3): Float = if isBehind(wo, wi) then inner.pdf(wo, wi) else 0f

  override protected def changed(wo: Vec3, s: BsdfSample): BsdfSample =
    if s.pdf > 0f && !isBehind(wo, s.wi) then BsdfSample.Absorbed else s

  override def regularized: Bsdf = FacetsBetween(inner.regularized)

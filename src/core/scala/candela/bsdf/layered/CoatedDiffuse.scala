package candela.bsdf.layered

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, Fresnel, Hemisphere, LeanBsdf, Material}
import candela.bsdf.microfacet.{
  MicrofacetDistribution, MicrofacetReflection, Roughness, TrowbridgeReitz
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{RgbTexture, Textured}

import scala.annotation.unused

/** A Lambertian base under a clear coat, with all interreflection between them.
  *
  * The base scatters uniformly, so the sum over all paths separates: transmission along `wo`, a
  * geometric series of reflections between base and coat, and transmission along `wi`,
  *
  *   f = f_top + T(wo) T(wi) / (π eta²) · albedo · Σ (albedo · R)^k,
  *
  * with T and R of the [[Coat]]. PBRT 4 estimates the same sum by random walks inside every
  * evaluation; `CoatedDiffuseSuite` checks against such a walk.
  *
  * @param series of the base's reflections
  * @param top    roughness of the outer interface
  * @param coat   transmittance and internal reflectance; its roughness may differ slightly from
  *               `top`
  * @param gloss  scale of the reflection at the outer interface
  * @param albedo of the base, if it is [[diffuseReflectance]]
  *
  * Source of the model: Guo, Hašan and Zhao, "Position-Free Monte Carlo Simulation for Arbitrary
  * Layered BSDFs", SIGGRAPH Asia 2018; PBRT 4th ed., §14.3.
  */
final class CoatedDiffuse(
    series: BaseSeries,
    top: MicrofacetDistribution,
    coat: Coat,
    gloss: Rgb = Rgb.White,
    albedo: Rgb | Null = null
) extends LeanBsdf:
  private val eta = coat.eta
  private val topIsSmooth = top.isSmooth || eta == 1f
  private val scale = InvPi / (eta * eta)
  private val fullSeries = series.full(coat)
  private val base = fullSeries * scale
  private val sampledBase =
    val sampledSeries = series.sampled(coat, fullSeries)
    if sampledSeries eq fullSeries then base else sampledSeries * scale
  private val meanBase = base.max * Pi * coat.meanTransmittance

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isSameSide(wo, wi) then reflected(base, wo, wi) else Rgb.Black

  /** Of directions on the same side. */
  private def reflected(base: Rgb, wo: Vec3, wi: Vec3): Rgb =
    base * (coat.transmittance(wo) * coat.transmittance(wi)) + gloss * topValue(wo, wi)

  private def topValue(wo: Vec3, wi: Vec3): Float =
    if topIsSmooth then 0f
    else
      val o = Hemisphere.above(wo)
      val i = Hemisphere.above(wi)
      val m = (o + i).normalized
      val cosM = o dot m
      // As in MicrofacetReflection
      if cosM <= 0f then 0f
      else Fresnel.dielectric(cosM, eta) * top.d(m) * top.visibility(o, i, m)

  /** Probability of sampling the outer interface: its fraction of the reflected power. */
  private def topChance(reflected: Float, wo: Vec3): Float =
    val basePower = meanBase * coat.transmittance(wo)
    if reflected + basePower > 0f then reflected / (reflected + basePower) else 0f

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !Hemisphere.isSameSide(wo, wi) then 0f
    else
      val chance = topChance(Fresnel.dielectric(Math.abs(wo.z), eta), wo)
      val baseDensity = (1f - chance) * Hemisphere.cosinePdf(wi)
      if topIsSmooth then baseDensity
      else
        val o = Hemisphere.above(wo)
        val m = (o + Hemisphere.above(wi)).normalized
        baseDensity + chance * MicrofacetReflection.pdf(top, o, m)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val reflected = Fresnel.dielectric(Math.abs(wo.z), eta)
    val chance = topChance(reflected, wo)
    if choice >= chance then weigh(wo, Hemisphere.cosineSample(wo, u1, u2), out)
    else if topIsSmooth then
      val weight = gloss * (reflected / chance)
      out.set(Hemisphere.mirrored(wo), weight, chance, isSpecular = true)
    else
      val o = Hemisphere.above(wo)
      val m = top.sample(o, u1, u2)
      val i = Hemisphere.reflected(o, m, o dot m)
      weigh(wo, Hemisphere.seenFrom(wo, i), out)

  private def weigh(wo: Vec3, wi: Vec3, out: Bounce): Unit =
    val density = pdf(wo, wi)
    if density > 0f then
      val weight = reflected(sampledBase, wo, wi) * (Hemisphere.absCos(wi) / density)
      out.set(wi, weight, density, isSpecular = false)
    else out.absorb()

  override def diffuseReflectance(wo: Vec3): Rgb =
    if albedo == null then super.diffuseReflectance(wo) else albedo

  def flags: BsdfFlags = BsdfFlags.Diffuse | BsdfFlags.Glossy | BsdfFlags.Choosing

  // Cached: the series of a spectrum is expensive
  override lazy val regularized: Bsdf =
    new CoatedDiffuse(series, top.regularized, coat.regularized, gloss, albedo)

/** What the base under a [[CoatedDiffuse]] reflects, with all that the coat sends back to it. */
abstract class BaseSeries:
  /** albedo · Σ (albedo · R)^k, by colour. */
  def full(coat: Coat): Rgb

  /** The same for sampled directions, which may have one reflection fewer.
    *
    * @param full that under the same coat
    */
  def sampled(@unused coat: Coat, full: Rgb): Rgb = full

object BaseSeries:
  /** Of at most `baseHits` reflections at the base, and `sampledBaseHits` for sampled directions
    * ([[LayerMedium.sampledBaseHits]]).
    */
  abstract class OfHits(baseHits: Int, sampledBaseHits: Int) extends BaseSeries:
    protected def upTo(hits: Int, coat: Coat): Rgb
    final def full(coat: Coat): Rgb = upTo(baseHits, coat)
    final override def sampled(coat: Coat, full: Rgb): Rgb =
      if sampledBaseHits == baseHits then full else upTo(sampledBaseHits, coat)

  /** @param albedo of the base, in [0, 1] */
  final class OfColor(albedo: Rgb, baseHits: Int, sampledBaseHits: Int)
      extends OfHits(baseHits, sampledBaseHits):
    protected def upTo(hits: Int, coat: Coat): Rgb = albedo.map(sum(_, hits, coat))

  /** @param ofReflectance applies a function to the base's reflectance, by wavelength */
  final class OfSpectrum(
      ofReflectance: (Float => Float) => Rgb,
      baseHits: Int,
      sampledBaseHits: Int
  ) extends OfHits(baseHits, sampledBaseHits):
    protected def upTo(hits: Int, coat: Coat): Rgb = ofReflectance(sum(_, hits, coat))

  /** albedo · Σ (albedo · R)^k by Horner's scheme, for k below `baseHits`. */
  def sum(albedo: Float, baseHits: Int, coat: Coat): Float =
    var total = 0f
    var k = 0
    while k < baseHits do
      total = albedo * (1f + coat.internalReflectance * total)
      k += 1
    total

/** [[CoatedDiffuse]]; `reflectance` is clamped to [0, 1].
  *
  * @param medium     limits the reflections at the base
  * @param bySpectrum applies a function to the reflectance spectrum, wavelength by wavelength, if
  *                   the spectrum is known: interreflection under the coat is not linear in colour.
  *                   Expensive; used for constant surfaces only
  */
final class CoatedDiffuseMaterial private (
    reflectance: RgbTexture,
    roughness: Roughness,
    coating: CoatedDiffuseMaterial.Coating,
    medium: LayerMedium,
    bySpectrum: Option[(Float => Float) => Rgb]
) extends Material,
      Textured(reflectance, roughness):
  private val spectrum = bySpectrum.filter(_ => isConstant)

  def bsdf(at: ShadingPoint): Bsdf =
    val top = roughness.trowbridgeReitz(at)
    val coat = coating.coatOf(top)
    val (baseHits, sampledBaseHits) = (medium.baseHits, medium.sampledBaseHits)
    val series = spectrum match
      case Some(ofReflectance) => BaseSeries.OfSpectrum(ofReflectance, baseHits, sampledBaseHits)
      case None => BaseSeries.OfColor(reflectance.albedo(at), baseHits, sampledBaseHits)
    CoatedDiffuse(series, top, coat)

object CoatedDiffuseMaterial:

  /** The coats of a roughness.
    *
    * @param thickness in mean free paths of the coat's absorption
    */
  private final class Coating(roughness: Roughness, eta: Float, thickness: Float, coats: Coats):
    // Made when a ray needs it: a rough coat takes a hundred thousand samples
    lazy val coatOf: TrowbridgeReitz => Coat =
      if roughness.isConstant then
        val coat = coats.of(roughness.trowbridgeReitz(ShadingPoint()), eta, thickness)
        _ => coat
      else
        val family = coats.family(eta, thickness)
        Coats.interpolate(family, _)

  /** Makes a material of a reflectance, with the given medium between coat and base. Random walks
    * are used only if the medium scatters or its thickness varies.
    */
  def family(
      roughness: Roughness,
      eta: Float,
      medium: LayerMedium,
      coats: Coats
  ): (RgbTexture, Option[(Float => Float) => Rgb]) => Material =
    val summed =
      for
        thickness <- medium.thickness.constant
        _ <- medium.albedo.constant.filter(_.max <= 0f)
      yield
        val coating = Coating(roughness, eta, thickness, coats)
        (reflectance: RgbTexture, bySpectrum: Option[(Float => Float) => Rgb]) =>
          new CoatedDiffuseMaterial(reflectance, roughness, coating, medium, bySpectrum)
    summed.getOrElse: (reflectance, _) =>
      LayeredMaterial(DiffuseLayers(reflectance, roughness, eta, medium))

  /** As above, of one. */
  def apply(
      reflectance: RgbTexture,
      roughness: Roughness,
      eta: Float,
      medium: LayerMedium,
      coats: Coats,
      bySpectrum: Option[(Float => Float) => Rgb] = None
  ): Material = family(roughness, eta, medium, coats)(reflectance, bySpectrum)

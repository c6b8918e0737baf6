package candela.bsdf.microfacet

import candela.bsdf.{
  Bounce, Bsdf, BsdfFlags, Fresnel, Hemisphere, LeanBsdf, Material, MaterialFlags, ReflectanceCurve,
  WrappedBsdf, WrappedMaterial
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture, Textured}

/** A rough dielectric interface: each microfacet reflects and refracts.
  *
  * Multiple scattering within the roughness is lost. Refraction scales radiance by the square of
  * the relative index, so that `f(wo, wi) · eta² = f(wi, wo)` for `wo` above and `wi` below.
  *
  * @param eta           index of refraction inside (below the surface) over that outside; not 1
  * @param reflectance   scale of the reflected light
  * @param transmittance scale of the refracted light
  * @param curve         what microfacets reflect, instead of the Fresnel term; negative cosines are
  *                      those from inside
  *
  * Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
  */
final class RoughDielectric(
    distribution: MicrofacetDistribution,
    eta: Float,
    reflectance: Rgb = Rgb.White,
    transmittance: Rgb = Rgb.White,
    curve: Option[ReflectanceCurve] = None
) extends LeanBsdf:
  import RoughDielectric.{facet, jacobian}

  private val mirror: ReflectanceCurve | Null = curve.orNull

  private val maxReflectance = reflectance.max
  private val maxTransmittance = transmittance.max

  /** Index of refraction on the other side over that on the side of `wo`. */
  private def relativeEta(wo: Vec3): Float = if wo.z < 0f then 1f / eta else eta

  /** What a microfacet reflects, given its Fresnel term. */
  private def reflected(wo: Vec3, cosM: Float, fresnel: Float): Rgb =
    if mirror == null then reflectance * fresnel
    else reflectance * mirror(oriented(wo, cosM))

  private def oriented(wo: Vec3, cosM: Float): Float = if wo.z < 0f then -cosM else cosM

  /** What a microfacet refracts. */
  private def refracted(wo: Vec3, cosM: Float, fresnel: Float): Float =
    if mirror == null then 1f - fresnel else mirror.transmitted(oriented(wo, cosM), fresnel)

  /** Probability of sampling reflection given the Fresnel term; NaN if the surface is black. */
  private def reflects(wo: Vec3, cosM: Float, fresnel: Float): Float =
    val r =
      if mirror == null then fresnel * maxReflectance else reflected(wo, cosM, fresnel).max
    r / (r + refracted(wo, cosM, fresnel) * maxTransmittance)

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isLevel(wo, wi) then Rgb.Black
    else
      val relative = relativeEta(wo)
      val o = Hemisphere.above(wo)
      val i = Hemisphere.seenFrom(wo, wi)
      val m = facet(o, i, relative)
      if m.isZero then Rgb.Black
      else
        val fresnel = Fresnel.dielectric(o dot m, relative)
        val density = distribution.d(m) * distribution.visibility(o, i, m)
        if i.z > 0f && mirror == null then reflectance * (fresnel * density)
        else if i.z > 0f then reflected(wo, o dot m, fresnel) * density
        else
          val spread = 4f * (o dot m) * jacobian(o, i, m, relative) / (relative * relative)
          transmittance * (refracted(wo, o dot m, fresnel) * density * spread)

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isLevel(wo, wi) then 0f
    else
      val relative = relativeEta(wo)
      val o = Hemisphere.above(wo)
      val i = Hemisphere.seenFrom(wo, wi)
      val m = facet(o, i, relative)
      if m.isZero then 0f else density(wo, o, i, m, relative)

  private def density(wo: Vec3, o: Vec3, i: Vec3, m: Vec3, relative: Float): Float =
    val cosM = o dot m
    val p = reflects(wo, cosM, Fresnel.dielectric(cosM, relative))
    if p.isNaN then 0f
    else if i.z > 0f then p * MicrofacetReflection.pdf(distribution, o, m)
    else (1f - p) * distribution.pdf(o, m) * jacobian(o, i, m, relative)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val relative = relativeEta(wo)
    val o = Hemisphere.above(wo)
    val m = distribution.sample(o, u1, u2)
    val cosM = o dot m
    if o.z < Hemisphere.Horizon || cosM <= 0f then out.absorb()
    else
      val fresnel = Fresnel.dielectric(cosM, relative)
      val p = reflects(wo, cosM, fresnel)
      if p.isNaN then out.absorb()
      else if choice < p then
        val i = Hemisphere.reflected(o, m, cosM)
        if i.z < Hemisphere.Horizon then out.absorb()
        else if mirror == null then
          setSample(wo, o, i, m, reflectance * (fresnel / p), relative, 1f, out)
        else setSample(wo, o, i, m, reflected(wo, cosM, fresnel) * (1f / p), relative, 1f, out)
      else
        val cosT = Fresnel.cosRefracted(cosM, relative)
        if cosT <= 0f then out.absorb()
        else
          val i = Fresnel.refracted(o, m, cosM, cosT, relative)
          val share = refracted(wo, cosM, fresnel) / ((1f - p) * relative * relative)
          val passed = transmittance * share
          if i.z > -Hemisphere.Horizon then out.absorb()
          else setSample(wo, o, i, m, passed, relative, relative, out)

  private def setSample(
      wo: Vec3,
      o: Vec3,
      i: Vec3,
      m: Vec3,
      weight: Rgb,
      relative: Float,
      sampleEta: Float,
      out: Bounce
  ): Unit =
    val pdf = density(wo, o, i, m, relative)
    if pdf > 0f && java.lang.Float.isFinite(pdf) then
      val wi = Hemisphere.seenFrom(wo, i)
      out.set(wi, weight * distribution.sampleWeight(o, i, m), pdf, false, sampleEta)
    else out.absorb()

  val flags: BsdfFlags =
    val common = distribution.flags | BsdfFlags.Choosing
    if transmittance.isBlack then common else common | BsdfFlags.Transmissive

  override def regularized: Bsdf =
    RoughDielectric(distribution.regularized, eta, reflectance, transmittance, curve)

object RoughDielectric:

  /** The microfacet normal that scatters `o` (above) to `i`; zero if none is visible to both.
    *
    * @param relative index beyond the interface over that above it
    */
  private[bsdf] def facet(o: Vec3, i: Vec3, relative: Float): Vec3 =
    val across = if i.z > 0f then o + i else o + i * relative
    if across.isZero then Vec3.Zero
    else
      val unit = across.normalized
      val m = if unit.z < 0f then -unit else unit
      if (o dot m) > 0f && (i dot m) * i.z > 0f then m else Vec3.Zero

  /** Jacobian from refracted directions to microfacet normals. */
  private[bsdf] def jacobian(o: Vec3, i: Vec3, m: Vec3, relative: Float): Float =
    val cosI = i dot m
    Math.abs(cosI) / square(cosI + (o dot m) / relative)

/** A rough or smooth dielectric interface. */
object Dielectric:
  def apply(
      distribution: MicrofacetDistribution,
      eta: Float,
      reflectance: Rgb = Rgb.White,
      transmittance: Rgb = Rgb.White
  ): Bsdf =
    // Nearly matched indices refract by at most 1e-4 at any roughness; Float directions can't
    // resolve which microfacet did it.
    val isMatched = Math.abs(eta - 1f) < Matched
    if distribution.isSmooth || isMatched then SmoothDielectric(eta, reflectance, transmittance)
    else RoughDielectric(distribution, eta, reflectance, transmittance)

  /** Difference of the relative index from 1 below which media count as matched. */
  private inline val Matched = 1e-4f

/** Dielectrics such as glass and water.
  *
  * @param kr         scale of the reflected light
  * @param kt         scale of the refracted light
  * @param eta        index of refraction inside over that outside; 0 means 1
  * @param roughness  must be smooth unless `compresses`
  * @param compresses see [[SmoothDielectric]]
  */
final class DielectricMaterial(
    kr: RgbTexture,
    kt: RgbTexture,
    eta: FloatTexture,
    roughness: Roughness,
    compresses: Boolean = true
) extends Material,
      Textured(kr, kt, eta, roughness):
  def bsdf(at: ShadingPoint): Bsdf =
    val distribution = roughness(at)
    val raw = eta(at)
    val index = if raw == 0f then 1f else raw
    val reflectance = kr.positive(at)
    val transmittance = kt.positive(at)
    if compresses then Dielectric(distribution, index, reflectance, transmittance)
    else SmoothDielectric(index, reflectance, transmittance, compresses = false)

  override def flags: MaterialFlags = roughness.flags

object DielectricMaterial:

  /** PBRT 4's dielectric. */
  def apply(eta: Float, roughness: Roughness): DielectricMaterial =
    new DielectricMaterial(White, White, ConstantFloat(eta), roughness)

  /** PBRT 2's glass: always smooth, and refraction doesn't scale radiance. */
  def pbrt2Glass(kr: RgbTexture, kt: RgbTexture, eta: FloatTexture): DielectricMaterial =
    new DielectricMaterial(kr, kt, eta, Roughness.Smooth, compresses = false)

  private val White = ConstantRgb(Rgb.White)

/** A BSDF at one wavelength, whose light of other wavelengths is scattered to other directions. */
final class Dispersive(inner: Bsdf) extends WrappedBsdf(inner):
  override def flags: BsdfFlags = inner.flags | BsdfFlags.Dispersive
  override def regularized: Bsdf = Dispersive(inner.regularized)

/** A material whose scattering depends on the wavelength; `inner` is that for the hero's. */
final class DispersiveMaterial(inner: Material) extends WrappedMaterial(inner):
  def bsdf(at: ShadingPoint): Bsdf = Dispersive(inner.bsdf(at))
  override def flags: MaterialFlags = inner.flags | MaterialFlags.Dispersive

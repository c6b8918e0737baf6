package candela.bsdf.layered

import candela.bsdf.{Bsdf, BsdfFlags, BsdfSample, Fresnel, Hemisphere, JoinedMaterial, Material}
import candela.bsdf.microfacet.{MicrofacetDistribution, MicrofacetReflection, Roughness}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.RgbTexture

/** Any BSDF under a dielectric coat that absorbs. Light that the coat reflects back inside is lost,
  * and roughness bends no light on its way through:
  *
  *   f(wo, wi) = f_top + T(wo) T(wi) A(wo', wi') f_inner(wo', wi') / eta²,
  *
  * with the directions wo', wi' within the coat, T of the [[Coat]], and Beer's law A.
  *
  * @param top        roughness of the outer interface
  * @param coat       what the interface lets pass
  * @param absorption optical thickness of the coat
  * @param gloss      scale of the reflection at the outer interface
  *
  * Source: Weidlich and Wilkie, "Arbitrarily Layered Micro-Facet Surfaces", GRAPHITE 2007; Mitsuba
  * 0.6, "coating" and "roughcoating".
  */
final class Coated(
    inner: Bsdf,
    top: MicrofacetDistribution,
    coat: Coat,
    absorption: Rgb,
    gloss: Rgb
) extends Bsdf:
  private val eta = coat.eta
  private val isClear = absorption.isBlack

  /** The direction beyond an interface of this index, on the same side; zero if there is none. */
  private def bent(w: Vec3, eta: Float): Vec3 =
    val cosT = Fresnel.cosRefracted(Math.min(Hemisphere.absCos(w), 1f), eta)
    if cosT <= 0f then Vec3.Zero
    else Vec3(w.x / eta, w.y / eta, if w.z < 0f then -cosT else cosT).normalized

  private def absorbed(a: Vec3, b: Vec3): Rgb =
    if isClear then Rgb.White
    else
      val pathLength = 1f / Hemisphere.absCos(a) + 1f / Hemisphere.absCos(b)
      absorption.map(s => exp(-s * pathLength))

  /** What reaches the inner BSDF and leaves again. */
  private def passed(wo: Vec3, wi: Vec3, o: Vec3, i: Vec3): Rgb =
    absorbed(o, i) * (coat.transmittance(wo) * coat.transmittance(wi))

  /** Probability of sampling the outer interface. */
  private def topChance(wo: Vec3): Float =
    val through = coat.transmittance(wo)
    val reflected = (1f - through) * gloss.max
    if reflected > 0f then reflected / (reflected + through) else 0f

  private def hasFacets(wo: Vec3, wi: Vec3) = !top.isSmooth && Hemisphere.isSameSide(wo, wi)

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isLevel(wo, wi) then Rgb.Black
    else
      val (o, i) = (bent(wo, eta), bent(wi, eta))
      val innerTerm =
        if o.isZero || i.isZero then Rgb.Black
        else inner.f(o, i) * passed(wo, wi, o, i) * (1f / (eta * eta))
      if !hasFacets(wo, wi) then innerTerm
      else
        val (a, b) = (Hemisphere.above(wo), Hemisphere.above(wi))
        val m = (a + b).normalized
        val cosM = a dot m
        if cosM <= 0f then innerTerm
        else
          innerTerm + gloss * (Fresnel.dielectric(cosM, eta) * top.d(m) * top.visibility(a, b, m))

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isLevel(wo, wi) then 0f
    else
      val chance = topChance(wo)
      val (o, i) = (bent(wo, eta), bent(wi, eta))
      val innerDensity =
        if o.isZero || i.isZero then 0f
        else
          // Solid angles within the coat are smaller
          val spread = Hemisphere.absCos(wi) / (eta * eta * Hemisphere.absCos(i))
          (1f - chance) * inner.pdf(o, i) * spread
      if !hasFacets(wo, wi) then innerDensity
      else
        val (a, b) = (Hemisphere.above(wo), Hemisphere.above(wi))
        innerDensity + chance * MicrofacetReflection.pdf(top, a, (a + b).normalized)

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val chance = topChance(wo)
    if choice < chance then sampledTop(wo, chance, u1, u2)
    else
      val remapped = clamp((choice - chance) / (1f - chance), 0f, OneMinusEpsilon)
      sampledInner(wo, 1f - chance)(inner.sample(_, remapped, u1, u2))

  override def sampleSpecular(wo: Vec3, choice: Float): BsdfSample =
    val isMirror = top.isSmooth && topChance(wo) > 0f
    if isMirror && (!inner.flags.hasAny(BsdfFlags.Specular) || choice < 0.5f) then
      sampledTop(wo, if inner.flags.hasAny(BsdfFlags.Specular) then 0.5f else 1f, 0.5f, 0.5f)
    else
      val share = if isMirror then 0.5f else 1f
      val remapped = if isMirror then clamp(2f * choice - 1f, 0f, OneMinusEpsilon) else choice
      sampledInner(wo, share)(inner.sampleSpecular(_, remapped))

  private def sampledTop(wo: Vec3, chance: Float, u1: Float, u2: Float): BsdfSample =
    if top.isSmooth then
      val weight = gloss * (Fresnel.dielectric(Hemisphere.absCos(wo), eta) / chance)
      BsdfSample(Hemisphere.mirrored(wo), weight, chance, isSpecular = true)
    else
      val o = Hemisphere.above(wo)
      val m = top.sample(o, u1, u2)
      weighed(wo, Hemisphere.seenFrom(wo, Hemisphere.reflected(o, m, o dot m)), isNear = true, 1f)

  private def sampledInner(wo: Vec3, share: Float)(sample: Vec3 => BsdfSample): BsdfSample =
    val o = bent(wo, eta)
    val s = if o.isZero then BsdfSample.Absorbed else sample(o)
    val wi = if s.pdf > 0f then bent(s.wi, 1f / eta) else Vec3.Zero
    if wi.isZero then BsdfSample.Absorbed
    else if s.isSpecular then
      val weight = s.weight * passed(wo, wi, o, s.wi) * (1f / share)
      BsdfSample(wi, weight, s.pdf * share, isSpecular = true, s.eta)
    else weighed(wo, wi, wo.z * wi.z > 0f, s.eta)

  private def weighed(wo: Vec3, wi: Vec3, isNear: Boolean, eta: Float): BsdfSample =
    val isOnSide = if isNear then Hemisphere.isSameSide(wo, wi) else !Hemisphere.isLevel(wo, wi)
    val density = if isOnSide then pdf(wo, wi) else 0f
    if density <= 0f then BsdfSample.Absorbed
    else
      val weight = f(wo, wi) * (Hemisphere.absCos(wi) / density)
      BsdfSample(wi, weight, density, isSpecular = false, eta)

  val flags: BsdfFlags =
    val outer =
      if top.isSmooth then BsdfFlags.Specular | BsdfFlags.Narrow else top.flags
    inner.flags.minus(BsdfFlags.Pane) | outer | BsdfFlags.Choosing

  override def regularized: Bsdf =
    Coated(inner.regularized, top.regularized, coat.regularized, absorption, gloss)

/** [[Coated]].
  *
  * @param roughness  of the coat; what it lets pass is that of the roughness at (0, 0)
  * @param absorption in the unit of 1 / `thickness`
  */
final class CoatingMaterial(
    inner: Material,
    roughness: Roughness,
    eta: Float,
    absorption: RgbTexture,
    thickness: Float,
    specular: RgbTexture,
    coats: Coats
) extends JoinedMaterial(inner, inner, roughness, absorption, specular):
  private lazy val coat: Coat = coats.clear(roughness, eta)

  def bsdf(at: ShadingPoint): Bsdf =
    val (top, depth) = (roughness(at), absorption.positive(at) * thickness)
    Coated(inner.bsdf(at), top, coat, depth, specular.positive(at))

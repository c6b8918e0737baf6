package candela.bsdf.composite

import candela.bsdf.{Bsdf, DiffuseTransmission, Lobes, Material}
import candela.bsdf.microfacet.{
  MicrofacetDistribution, MicrofacetReflection, Passthrough, RoughDielectric,
  SeparableTrowbridgeReitz, SmoothDielectric, TrowbridgeReitz
}
import candela.bsdf.subsurface.SubsurfaceMaterial
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantRgb, FloatTexture, RgbTexture, Textured}

/** Parameters of [[DisneyMaterial]], in [0, 1] unless stated otherwise.
  *
  * @param color           base colour; clamped to at least 0
  * @param metallic        0: dielectric, 1: metal
  * @param eta             index of refraction
  * @param specularTint    tint of dielectric highlights towards the hue of the base colour
  * @param anisotropic     anisotropy of highlights
  * @param sheen           grazing retro-reflection of cloth
  * @param sheenTint       tint of the sheen towards the hue of the base colour
  * @param clearcoat       strength of the clear coat lobe
  * @param clearcoatGloss  glossiness of the clear coat
  * @param transmission    fraction of the diffuse lobe replaced by refraction
  * @param isThin          whether the surface is a thin sheet
  * @param flatness        of a thin sheet: blend towards the flat diffuse lobe
  * @param diffTrans       of a thin sheet: diffusely transmitted fraction, 0 to 2
  * @param scatterDistance mean free path beneath the surface, in scene units; 0: no subsurface
  *                        scattering, as for a thin sheet
  */
final class DisneyParameters(
    val color: RgbTexture,
    val metallic: FloatTexture,
    val eta: FloatTexture,
    val roughness: FloatTexture,
    val specularTint: FloatTexture,
    val anisotropic: FloatTexture,
    val sheen: FloatTexture,
    val sheenTint: FloatTexture,
    val clearcoat: FloatTexture,
    val clearcoatGloss: FloatTexture,
    val transmission: FloatTexture,
    val isThin: Boolean,
    val flatness: FloatTexture,
    val diffTrans: FloatTexture,
    scatterDistance: RgbTexture = ConstantRgb(Rgb.Black)
) extends Textured(
      color, metallic, eta, roughness, specularTint, anisotropic, sheen, sheenTint, clearcoat,
      clearcoatGloss, transmission, flatness, diffTrans, scatterDistance
    ):
  val distance: RgbTexture = if isThin then ConstantRgb(Rgb.Black) else scatterDistance

  /** Whether there is subsurface scattering anywhere. */
  val isSubsurface: Boolean = distance.constant.forall(!_.isBlack)

  /** Anisotropic highlights need tangents. */
  override def isAnisotropic: Boolean = anisotropic.constant.forall(_ != 0f)

/** Disney's principled material, as in PBRT 3: diffuse lobes, a glossy lobe between plastic and
  * metal, a clear coat, and refraction.
  *
  * Sources: Burley 2012 and 2015 (see [[DisneyDiffuse]]); PBRT 3, "disney".
  */
final class DisneyMaterial(p: DisneyParameters) extends Material, Textured(p):

  def bsdf(at: ShadingPoint): Bsdf =
    val color = p.color.positive(at)
    val metallic = p.metallic(at)
    val eta = p.eta(at)
    val roughness = p.roughness(at)
    val transmission = p.transmission(at)
    val passing = if p.isThin then 0.5f * p.diffTrans(at) else 0f
    val luminance = color.luminance
    val hue = if luminance > 0f then color * (1f / luminance) else Rgb.White
    val aspect = safeSqrt(1f - 0.9f * p.anisotropic(at))
    def alpha(r: Float, stretch: Float) = Math.max(r * r * stretch, 1e-3f)

    val lobes = Lobes.Builder()
    val broad = (1f - metallic) * (1f - transmission)
    val scatters = broad > 0f && !p.distance(at).isBlack
    if broad > 0f then
      val base = if scatters then Rgb.Black else color * (broad * (1f - passing))
      addBroad(lobes, at, base, color * broad, broad, hue, roughness)
    // Uncoloured: the BSSRDF holds the colour
    val entering = if scatters then color.max * broad else 0f
    lobes.add(SmoothDielectric(eta, reflectance = Rgb.Black), entering)

    val tinted = Rgb.White * (1f - p.specularTint(at)) + hue * p.specularTint(at)
    val normal = tinted * (Schlick.normal(eta) * (1f - metallic)) + color * metallic
    val facets = SeparableTrowbridgeReitz(alpha(roughness, 1f / aspect), alpha(roughness, aspect))
    val curve = DisneyReflectance(normal, metallic, eta)
    val glossy = Math.max(normal.max, 0.04f)
    val passed = color.map(c => sqrt(c)) * transmission
    // One lobe, so that each microfacet reflects or refracts as often as its Fresnel term says
    val isGlass = !p.isThin && eta != 1f && !passed.isBlack
    if isGlass then
      lobes.add(
        RoughDielectric(facets, eta, transmittance = passed, curve = Some(curve)),
        glossy + passed.max
      )
    else lobes.add(MicrofacetReflection(facets, curve), glossy)
    val coat = p.clearcoat(at)
    def sharpness = ClearcoatDistribution(lerp(p.clearcoatGloss(at), 0.1f, 1e-3f))
    lobes.add(MicrofacetReflection(sharpness, ClearcoatReflectance, Rgb.gray(coat)), 0.04f * coat)
    val refracted = if isGlass then 0f else passed.max
    lobes.add(refraction(passed, eta, roughness, alpha, aspect, facets), refracted)
    val through = color * passing
    lobes.add(DiffuseTransmission(Rgb.Black, through), through.max)
    lobes.result

  /** @param base     colour of the light that exits where it entered
    * @param weighted colour times the weight of the diffuse lobes
    */
  private def addBroad(
      lobes: Lobes.Builder,
      at: ShadingPoint,
      base: Rgb,
      weighted: Rgb,
      share: Float,
      hue: Rgb,
      roughness: Float
  ): Unit =
    val flat = if p.isThin then p.flatness(at) else 0f
    val sheen = p.sheen(at)
    val cloth =
      if sheen > 0f then
        val tint = p.sheenTint(at)
        (Rgb.White * (1f - tint) + hue * tint) * (share * sheen)
      else Rgb.Black
    lobes.add(
      DisneyDiffuse(base * (1f - flat), base * flat, weighted, cloth, roughness),
      // Retro-reflection is small beside the rest
      Math.max(base.max, 0.1f * weighted.max) + 0.2f * cloth.max
    ): Unit

  /** For thin sheets the roughness depends on the index (Burley 2015, figure 15). */
  private def refraction(
      passed: Rgb,
      eta: Float,
      roughness: Float,
      alpha: (Float, Float) => Float,
      aspect: Float,
      facets: MicrofacetDistribution
  ): Bsdf =
    val spread =
      if p.isThin then
        val scaled = (0.65f * eta - 0.35f) * roughness
        TrowbridgeReitz(alpha(scaled, 1f / aspect), alpha(scaled, aspect))
      else facets
    // With matched indices, refraction bends nothing
    if eta == 1f then Passthrough(passed)
    else RoughDielectric(spread, eta, Rgb.Black, passed)

object DisneyMaterial:

  /** The material, with subsurface scattering if enabled. */
  def apply(p: DisneyParameters): Material =
    val surface = new DisneyMaterial(p)
    if p.isSubsurface then SubsurfaceMaterial(surface, DisneyInterior(p), alongTangents = true)
    else surface

package candela.bsdf.composite

import candela.bsdf.{Bsdf, DiffuseTransmission, Lobes, Material}
import candela.bsdf.microfacet.{
  MicrofacetDistribution, MicrofacetReflection, Passthrough, RoughDielectric, SmoothDielectric,
  TrowbridgeReitz
}
import candela.bsdf.subsurface.SubsurfaceMaterial
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantRgb, FloatTexture, RgbTexture, Textured}

/** What [[DisneyMaterial]] is made of, each from 0 to 1 unless said otherwise.
  *
  * @param color           of the surface; held to [0, 1]
  * @param metallic        0: dielectric, 1: metal
  * @param eta             index of refraction
  * @param specularTint    how far a dielectric's highlights have the hue of the colour
  * @param anisotropic     how much highlights are stretched
  * @param sheen           of cloth, at grazing angles
  * @param sheenTint       how far the sheen has the hue of the colour
  * @param clearcoat       strength of a second, thin gloss
  * @param clearcoatGloss  how sharp that is
  * @param transmission    how much of the diffuse part is refracted instead
  * @param isThin          is it a sheet of no thickness?
  * @param flatness        of a sheet: how far the diffuse part looks flat
  * @param diffTrans       of a sheet: how much of the diffuse part passes, 0 to 2
  * @param scatterDistance mean free path below the surface, in scene units; 0: light leaves where
  *                        it enters, as of a sheet
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

  /** Does light anywhere leave elsewhere than it enters? */
  val isSubsurface: Boolean = distance.constant.forall(!_.isBlack)

  /** Highlights are stretched along the tangents. */
  override def isAnisotropic: Boolean = anisotropic.constant.forall(_ != 0f)

/** The material that Disney's artists know, as PBRT 3 has it: a broad part, gloss between plastic
  * and metal, a clear coat, and refraction.
  *
  * Sources: Burley 2012 and 2015 (see [[DisneyDiffuse]]); PBRT 3, "disney".
  */
final class DisneyMaterial(p: DisneyParameters) extends Material, Textured(p):

  def bsdf(at: ShadingPoint): Bsdf =
    val color = p.color.albedo(at)
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
    // Its colour is that of what comes out
    val entering = if scatters then color.max * broad else 0f
    lobes.add(SmoothDielectric(eta, reflectance = Rgb.Black), entering)

    val tinted = Rgb.White * (1f - p.specularTint(at)) + hue * p.specularTint(at)
    val normal = tinted * (Schlick.normal(eta) * (1f - metallic)) + color * metallic
    val facets = SeparableTrowbridgeReitz(alpha(roughness, 1f / aspect), alpha(roughness, aspect))
    lobes.add(
      MicrofacetReflection(facets, DisneyReflectance(normal, metallic, eta)),
      Math.max(normal.max, 0.04f)
    )
    val coat = p.clearcoat(at)
    def sharpness = ClearcoatDistribution(lerp(p.clearcoatGloss(at), 0.1f, 1e-3f))
    lobes.add(MicrofacetReflection(sharpness, ClearcoatReflectance, Rgb.gray(coat)), 0.04f * coat)
    val passed = color.map(c => sqrt(c)) * transmission
    lobes.add(refraction(passed, eta, roughness, alpha, aspect, facets), passed.max)
    val through = color * passing
    lobes.add(DiffuseTransmission(Rgb.Black, through), through.max)
    lobes.result

  /** @param base     colour of what leaves where it entered
    * @param weighted colour, by the share of the broad part
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
      // What rough surfaces send back is little beside the rest
      Math.max(base.max, 0.1f * weighted.max) + 0.2f * cloth.max
    ): Unit

  /** Of a sheet, the roughness depends on the index (Burley 2015, figure 15). */
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
    // Without a change of index, refraction bends nothing
    if eta == 1f then Passthrough(passed)
    else RoughDielectric(spread, eta, Rgb.Black, passed)

object DisneyMaterial:

  /** With what is beneath it, if light gets there. */
  def apply(p: DisneyParameters): Material =
    val surface = new DisneyMaterial(p)
    if p.isSubsurface then SubsurfaceMaterial(surface, DisneyInterior(p), alongTangents = true)
    else surface

package candela.bsdf.composite

import candela.bsdf.{Bsdf, Fresnel, Lobes, Material, OneSided, ReflectanceCurve}
import candela.bsdf.microfacet.{MicrofacetReflection, RoughDielectric, SeparableTrowbridgeReitz}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.Textured

/** Mitsuba's `principled`: the lobes of [[DisneyMaterial]] with other weights. From behind only the
  * dielectric is seen.
  *
  * Sources: Burley 2012 and 2015 (see [[DisneyDiffuse]]); Mitsuba 3, "principled".
  */
final class PrincipledMaterial(p: DisneyParameters) extends Material, Textured(p):

  private val transmits = p.transmission.constant.forall(_ > 0f)

  def bsdf(at: ShadingPoint): Bsdf =
    val color = p.color.albedo(at)
    val metallic = p.metallic(at)
    val index = p.eta(at)
    // Matched indices would bend nothing
    val eta = if index == 1f && transmits then 1.001f else index
    val roughness = p.roughness(at)
    val hue = Principled.hue(color)
    val clear = (1f - metallic) * p.transmission(at)
    val diffuse = (1f - metallic) * (1f - p.transmission(at))

    val lobes = Lobes.Builder()
    val flat = p.flatness(at)
    val base = color * diffuse
    val cloth =
      if diffuse > 0f then
        Principled.tinted(hue, p.sheenTint(at)) * (p.sheen(at) * (1f - metallic))
      else Rgb.Black
    lobes.add(
      OneSided(
        DisneyDiffuse(base * (1f - flat), base * flat, base * (1f - flat), cloth, roughness)
      ),
      base.max + 0.2f * cloth.max
    )

    val facets = Principled.facets(roughness, p.anisotropic(at))
    val tint = p.specularTint(at)
    val curve = PrincipledReflectance(color, hue, metallic, tint, eta, clear)
    // What the dielectric doesn't reflect, the metal doesn't, either
    val glossy = if eta == 1f then 0f else Math.max(color.max * metallic, 0.04f)
    val passed = color.map(c => sqrt(c)) * clear
    // One lobe, so that each microfacet reflects or refracts as often as its Fresnel term says
    val glass = RoughDielectric(facets, eta, Rgb.White, passed, Some(curve))
    if passed.isBlack then lobes.add(MicrofacetReflection(facets, curve), glossy)
    else lobes.add(glass, glossy + passed.max)

    val coat = p.clearcoat(at)
    def sharp = ClearcoatDistribution(lerp(p.clearcoatGloss(at), 0.1f, 1e-3f), isBare = true)
    lobes.add(
      OneSided(MicrofacetReflection(sharp, ClearcoatReflectance, Rgb.gray(coat))),
      0.04f * coat
    )

    if passed.isBlack then lobes.result
    else
      lobes.result match
        case several: Lobes => BackedBy(several, glass)
        case single => single

/** What [[PrincipledMaterial]] and [[PrincipledThinMaterial]] share. */
private[composite] object Principled:

  /** The colour at a luminance of 1. */
  def hue(color: Rgb): Rgb =
    val luminance = color.luminance
    if luminance > 0f then color * (1f / luminance) else Rgb.White

  def tinted(hue: Rgb, fraction: Float): Rgb = Rgb.White * (1f - fraction) + hue * fraction

  def facets(roughness: Float, anisotropic: Float): SeparableTrowbridgeReitz =
    val aspect = safeSqrt(1f - 0.9f * anisotropic)
    def alpha(stretch: Float) = Math.max(roughness * roughness * stretch, 1e-3f)
    SeparableTrowbridgeReitz(alpha(1f / aspect), alpha(aspect))

/** Fresnel reflectance of [[PrincipledMaterial]]: a blend of a dielectric and of Schlick's
  * approximations for a metal and for a tinted dielectric.
  *
  * @param hue   colour of the tint
  * @param clear weight of the reflection from behind
  */
final class PrincipledReflectance(
    color: Rgb,
    hue: Rgb,
    metallic: Float,
    tint: Float,
    eta: Float,
    clear: Float
) extends ReflectanceCurve:
  private val tinted = hue * Schlick.normal(eta)
  private val dielectric = (1f - metallic) * (1f - tint)

  def apply(cosTheta: Float): Rgb =
    val exact = Fresnel.dielectric(cosTheta, eta)
    if cosTheta < 0f then Rgb.gray(clear * exact)
    else
      // For an index below 1, Schlick's formula takes the angle of refraction
      val cosine = if eta >= 1f then cosTheta else Math.max(Fresnel.cosRefracted(cosTheta, eta), 0f)
      val weight = Schlick.weight(cosine)
      def schlick(normal: Rgb) = normal.map(n => lerp(weight, n, 1f))
      Rgb.gray(dielectric * exact) + schlick(color) * metallic +
        schlick(tinted) * ((1f - metallic) * tint)

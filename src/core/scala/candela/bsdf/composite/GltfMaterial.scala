package candela.bsdf.composite

import candela.bsdf.{
  Bsdf, BsdfFlags, CosineSampled, Fresnel, Lobes, Material, ReflectanceCurve, SentThrough,
  WrappedBsdf
}
import candela.bsdf.microfacet.{MicrofacetReflection, RoughDielectric, TrowbridgeReitz}
import candela.color.Rgb
import candela.geometry.{Frame, ShadingPoint}
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured}

/** Parameters of [[GltfMaterial]], in [0, 1] unless stated otherwise; those that are out of their
  * range are clamped.
  *
  * @param color          base colour
  * @param metallic       0: dielectric, 1: metal
  * @param roughness      square root of the width of the microfacets' slopes
  * @param eta            index of refraction; below 1: a dielectric whose reflectance at normal
  *                       incidence is `specularColor`
  * @param specular       strength of the dielectric's reflection
  * @param specularColor  tint of the dielectric's reflection at normal incidence, from 0 on
  * @param transmission   fraction of the diffuse lobe replaced by transmission
  * @param isThin         whether what is transmitted keeps its direction, as through a thin wall
  * @param coat           strength of the clear coat
  * @param coatRoughness  roughness of the clear coat
  * @param sheen          colour of the fibres above the surface
  * @param sheenRoughness how far the fibres stray from the normal
  * @param anisotropy     of the highlights
  * @param iridescence    a film above the surface, under the clear coat
  * @param diffuseTransmission      fraction of the diffuse lobe that is transmitted instead of
  *                                 reflected
  * @param diffuseTransmissionColor colour of that
  */
final class GltfParameters(
    val color: RgbTexture,
    val metallic: FloatTexture,
    val roughness: FloatTexture,
    val eta: Float,
    val specular: FloatTexture,
    val specularColor: RgbTexture,
    val transmission: FloatTexture,
    val isThin: Boolean,
    val coat: FloatTexture,
    val coatRoughness: FloatTexture,
    val sheen: RgbTexture,
    val sheenRoughness: FloatTexture,
    val anisotropy: GltfAnisotropy,
    val iridescence: GltfIridescence,
    val diffuseTransmission: FloatTexture,
    val diffuseTransmissionColor: RgbTexture
) extends Textured(
      color, metallic, roughness, specular, specularColor, transmission, coat, coatRoughness,
      sheen, sheenRoughness, anisotropy, iridescence, diffuseTransmission, diffuseTransmissionColor
    )

/** How highlights are stretched.
  *
  * @param strength 0: not at all
  * @param x, y     direction from the tangent to the bitangent, from 0 for -1 to 1
  * @param rotation of the direction, in radians
  */
final class GltfAnisotropy(
    val strength: FloatTexture,
    x: FloatTexture,
    y: FloatTexture,
    rotation: Float
) extends Textured(strength, x, y):
  override def isAnisotropic: Boolean = strength.constant.forall(_ != 0f)

  private val cosine = cos(rotation)
  private val sine = sin(rotation)

  /** Turns the frame's tangent into that direction. */
  def turn(at: ShadingPoint): Unit =
    val (dx, dy) = (2f * x(at) - 1f, 2f * y(at) - 1f)
    val (along, across) = (cosine * dx - sine * dy, sine * dx + cosine * dy)
    if across != 0f || along < 0f then
      val turned = at.frame.s.toVec3 * along + at.frame.t.toVec3 * across
      at.frame.set(Frame.along(at.frame.n.toVec3, turned.normalized))

/** A thin film that varies.
  *
  * @param weight    0: none
  * @param eta       index of refraction
  * @param thinnest  thickness in nm where `thickness` is 0
  * @param thickest  where it is 1
  */
final class GltfIridescence(
    weight: FloatTexture,
    eta: Float,
    thinnest: Float,
    thickest: Float,
    thickness: FloatTexture,
    colors: FilmColors
) extends Textured(weight, thickness):

  /** Null where there is none. */
  private[composite] def apply(at: ShadingPoint): ThinFilm | Null =
    val present = clamp(weight(at), 0f, 1f)
    if present == 0f then null
    else ThinFilm(present, eta, lerp(thickness(at), thinnest, thickest), colors)

/** The material of glTF 2.0: a blend of a metal and of a dielectric over a diffuse base, with the
  * layers of its extensions. The same on both sides, unless it encloses a volume.
  *
  * Sources: glTF 2.0 specification, appendix B; the extensions KHR_materials_ior, specular,
  * transmission, volume, clearcoat, sheen, anisotropy, iridescence and diffuse_transmission.
  */
final class GltfMaterial(p: GltfParameters) extends Material, Textured(p):
  import GltfMaterial.*

  /** At normal incidence. */
  private val reflectance = square((1f - p.eta) / (1f + p.eta))

  // Matched indices would bend nothing
  private val bending = if Math.abs(p.eta - 1f) < 1e-3f then 1.001f else p.eta

  def bsdf(at: ShadingPoint): Bsdf =
    val color = p.color.albedo(at)
    val metallic = unit(p.metallic(at))
    val transmission = unit(p.transmission(at))
    val specular = unit(p.specular(at))
    val f0 = p.specularColor.positive(at).map(c => Math.min(c * reflectance, 1f) * specular)
    val fresnel = GltfReflectance(f0, specular, color, metallic, p.iridescence(at))
    val distribution = distributionAt(at)

    val lobes = Lobes.Builder()
    val diffuseWeight = (1f - metallic) * (1f - transmission)
    val diffuseTransmission = unit(p.diffuseTransmission(at))
    val reflected = color * (diffuseWeight * (1f - diffuseTransmission))
    lobes.add(GltfDiffuse(reflected, fresnel), reflected.max)
    if diffuseWeight * diffuseTransmission > 0f then
      val transmitted =
        p.diffuseTransmissionColor.albedo(at) * (diffuseWeight * diffuseTransmission)
      val through = SentThrough(GltfDiffuse(transmitted, fresnel))
      val refracts = transmission > 0f && !p.isThin
      lobes.add(
        if refracts then UncompressedTransmission(through) else through,
        transmitted.max
      ): Unit
    val transmissionWeight = (1f - metallic) * transmission
    val transmissionColor = color * transmissionWeight
    val glossy = Math.max(fresnel(1f).max, 0.04f)
    if transmissionColor.isBlack then lobes.add(MicrofacetReflection(distribution, fresnel), glossy)
    else if p.isThin then
      lobes.add(MicrofacetReflection(distribution, fresnel), glossy)
      lobes.add(
        SentThrough(MicrofacetReflection(distribution, fresnel.passed, transmissionColor)),
        transmissionColor.max
      )
    else
      // One lobe, so that each microfacet reflects or refracts as often as its Fresnel term says
      val interface = GltfInterface(fresnel, bending, transmissionWeight)
      lobes.add(
        RoughDielectric(distribution, bending, Rgb.White, transmissionColor, Some(interface)),
        glossy + transmissionColor.max
      )
    coated(at, fibrous(at, lobes.result))

  private def distributionAt(at: ShadingPoint): TrowbridgeReitz =
    val alpha = alphaOf(p.roughness(at))
    val strength = unit(p.anisotropy.strength(at))
    if strength > 0f then p.anisotropy.turn(at)
    TrowbridgeReitz(lerp(square(strength), alpha, 1f), alpha)

  private def fibrous(at: ShadingPoint, base: Bsdf): Bsdf =
    val sheen = p.sheen.albedo(at)
    if sheen.isBlack then base
    else
      val roughness = Math.max(unit(p.sheenRoughness(at)), MinSheenRoughness)
      Lobes.Builder()
        .add(UnderFibres(base, sheen.max, roughness), 1f)
        .add(CharlieSheen(sheen, square(roughness)), 0.2f * sheen.max)
        .result

  private def coated(at: ShadingPoint, base: Bsdf): Bsdf =
    val coat = unit(p.coat(at))
    if coat == 0f then base
    else GltfCoat.covering(base, GltfCoat.layer(coat, p.coatRoughness(at)), coat, Vec3.Z)

object GltfMaterial:
  /** Narrower microfacets than these are lost in the rounding of directions. */
  private inline val MinAlpha = 1e-3f

  /** The fibres' distribution has no limit at 0. */
  private inline val MinSheenRoughness = 0.05f

  private[composite] def unit(x: Float): Float = clamp(x, 0f, 1f)
  private[composite] def alphaOf(roughness: Float): Float =
    Math.max(square(unit(roughness)), MinAlpha)

/** Fresnel reflectance of [[GltfMaterial]], by Schlick's approximation.
  *
  * @param f0       of the dielectric, at normal incidence
  * @param grazing  of the dielectric, at grazing incidence
  * @param color    of the metal, at normal incidence
  * @param film     above either; null: none
  */
final class GltfReflectance(
    f0: Rgb,
    grazing: Float,
    color: Rgb,
    metallic: Float,
    film: ThinFilm | Null = null
) extends ReflectanceCurve:

  /** By the weight of grazing incidence. */
  private[composite] def dielectric(cosTheta: Float, weight: Float): Rgb =
    filmed(f0.map(n => lerp(weight, n, grazing)), f0, cosTheta)

  private def dielectric(cosTheta: Float): Rgb =
    dielectric(cosTheta, Schlick.weight(Math.abs(cosTheta)))

  private def filmed(bare: Rgb, f0: Rgb, cosTheta: Float): Rgb =
    val layer = film
    if layer == null then bare else layer.coated(bare, f0, cosTheta)

  def apply(cosTheta: Float): Rgb = blend(dielectric(cosTheta), cosTheta)

  /** Of the reflectances of the dielectric and of the metal. */
  private[composite] def blend(dielectric: Rgb, cosTheta: Float): Rgb =
    if metallic == 0f then dielectric
    else
      val weight = Schlick.weight(Math.abs(cosTheta))
      val metal = filmed(color.map(c => lerp(weight, c, 1f)), color, cosTheta)
      dielectric * (1f - metallic) + metal * metallic

  /** What the dielectric doesn't reflect. */
  def passed(cosTheta: Float): Float = 1f - dielectric(cosTheta).max

  def passed: ReflectanceCurve = new ReflectanceCurve:
    def apply(cosTheta: Float): Rgb = Rgb.gray(passed(cosTheta))

/** Fresnel reflectance of the boundary of a volume: by the exact equations, scaled between the
  * reflectances at normal and grazing incidence. From inside, that of the dielectric alone.
  *
  * @param outer              that of the surface of a thin wall
  * @param transmissionWeight of the reflection from inside
  */
private final class GltfInterface(outer: GltfReflectance, eta: Float, transmissionWeight: Float)
    extends ReflectanceCurve:
  private val f0 = Schlick.normal(eta)

  def apply(cosTheta: Float): Rgb =
    if cosTheta < 0f then Rgb.gray(transmissionWeight * Fresnel.dielectric(cosTheta, eta))
    else outer.blend(dielectric(cosTheta), cosTheta)

  private def dielectric(cosTheta: Float): Rgb =
    val weight = clamp((Fresnel.dielectric(cosTheta, eta) - f0) / (1f - f0), 0f, 1f)
    outer.dielectric(cosTheta, weight)

  // A film may reflect more than the boundary
  override def transmitted(cosTheta: Float, fresnel: Float): Float =
    val outside =
      if cosTheta >= 0f then cosTheta else Fresnel.cosRefracted(-cosTheta, 1f / eta)
    if outside <= 0f then 0f
    else Math.min(1f - fresnel, 1f - dielectric(outside).max)

/** What passes a boundary diffusely beside light that is refracted. The radiance of that alone is
  * scaled by the square of the index.
  */
private final class UncompressedTransmission(base: Bsdf) extends WrappedBsdf(base):
  override def flags: BsdfFlags = base.flags | BsdfFlags.NonReciprocal
  override def regularized: Bsdf = UncompressedTransmission(base.regularized)

/** The diffuse base under a dielectric, which lets through what its microfacets don't reflect. */
final class GltfDiffuse(color: Rgb, fresnel: GltfReflectance) extends CosineSampled:
  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val across = wo + wi
    val cosine = if across.isZero then 0f else wi dot across.normalized
    color * (InvPi * fresnel.passed(cosine))

package candela.bsdf.composite

import candela.bsdf.{
  Bsdf, DielectricReflectance, DiffuseTransmission, Fresnel, JoinedMaterial, Lambert, Lobes,
  Material, SentThrough
}
import candela.bsdf.microfacet.{
  MicrofacetReflection, Passthrough, RoughDielectric, Roughness, SmoothDielectric
}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{FloatTexture, RgbTexture, Textured}

/** Edition of PBRT that a composite material follows. */
enum Edition:

  /** Plastic and uber use the Fresnel term of the inside of glass on either side: total internal
    * reflection beyond 42 degrees. Refraction doesn't scale radiance.
    */
  case Second

  /** Plastic swaps the inside and outside of the interface; uber is right. */
  case Third

/** Sum of a diffuse and a glossy lobe, without energy exchange. */
final class PlasticMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    roughness: Roughness,
    edition: Edition
) extends Material,
      Textured(kd, ks, roughness):
  private val curve = DielectricReflectance(1f / 1.5f, oriented = edition == Edition.Third)

  def bsdf(at: ShadingPoint): Bsdf =
    val diffuse = kd.positive(at)
    val gloss = ks.positive(at)
    Lobes.Builder()
      .add(Lambert(diffuse), diffuse.max)
      .add(MicrofacetReflection(roughness(at), curve, gloss), gloss.max)
      .result

/** Diffuse, glossy, specular reflection and transmission lobes under an `opacity`. */
final class UberMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    kr: RgbTexture,
    kt: RgbTexture,
    opacity: RgbTexture,
    eta: FloatTexture,
    roughness: Roughness,
    edition: Edition
) extends Material,
      Textured(kd, ks, kr, kt, opacity, eta, roughness):
  def bsdf(at: ShadingPoint): Bsdf =
    val third = edition == Edition.Third
    val index = if third then eta(at) else 1f / eta(at)
    val covered = opacity.positive(at)
    val open = (Rgb.White - covered).map(c => Math.max(c, 0f))
    val diffuse = kd.positive(at) * covered
    val gloss = ks.positive(at) * covered
    val mirror = kr.positive(at) * covered
    val clear = kt.positive(at) * covered
    val normalReflectance = Fresnel.dielectric(1f, index)
    val interface = normalReflectance * mirror.max + (1f - normalReflectance) * clear.max
    Lobes.Builder()
      .add(Passthrough(open), open.max)
      .add(Lambert(diffuse), diffuse.max)
      .add(
        MicrofacetReflection(roughness(at), DielectricReflectance(index, oriented = third), gloss),
        gloss.max
      )
      .add(SmoothDielectric(index, mirror, clear, compresses = third), interface)
      .result

/** A thin sheet with diffuse (`kd`) and glossy (`ks`) lobes. `reflect` and `transmit` scale their
  * reflection and transmission. All are clamped to ≥ 0.
  *
  * The glossy lobe is a rough dielectric of index 1.5 (PBRT 3), or a rough mirror with the same
  * Fresnel term, both reflected and transmitted (PBRT 2).
  */
final class TranslucentMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    reflect: RgbTexture,
    transmit: RgbTexture,
    roughness: Roughness,
    edition: Edition
) extends Material,
      Textured(kd, ks, reflect, transmit, roughness):
  import TranslucentMaterial.*
  private val mirror = DielectricReflectance(1f / Index, oriented = false)

  def bsdf(at: ShadingPoint): Bsdf =
    val r = reflect.positive(at)
    val t = transmit.positive(at)
    val diffuse = kd.positive(at)
    val gloss = ks.positive(at)
    val lobes = Lobes.Builder()
    val scattered = diffuse * (r + t)
    lobes.add(DiffuseTransmission(diffuse * r, diffuse * t), scattered.max)
    val distribution = roughness(at)
    edition match
      case Edition.Second =>
        lobes.add(MicrofacetReflection(distribution, mirror, gloss * r), (gloss * r).max)
        lobes.add(
          SentThrough(MicrofacetReflection(distribution, mirror, gloss * t)),
          (gloss * t).max
        )
      case Edition.Third =>
        val glossy = gloss * (r + t)
        lobes.add(RoughDielectric(distribution, Index, gloss * r, gloss * t), glossy.max)
    lobes.result

object TranslucentMaterial:
  private inline val Index = 1.5f

/** Blend of two materials: `amount` of the first, the rest of the second, if any is left. The
  * amount is at least 0 and, unless `gains`, at most 1, per channel.
  *
  * A blend of a material with itself is that material. The shading normal of the first is used for
  * both, as in PBRT 2 and 3.
  */
final class MixedMaterial(
    private[composite] val first: Material,
    private[composite] val second: Material,
    amount: RgbTexture,
    gains: Boolean = false
) extends JoinedMaterial(first, second, amount):
  private[composite] def amountAt(at: ShadingPoint): Rgb =
    if gains then amount.positive(at) else amount.albedo(at)

  def bsdf(at: ShadingPoint): Bsdf =
    if first eq second then MixedMaterial.scatter(first, at)
    else
      val fraction = amountAt(at)
      val complement = MixedMaterial.complement(fraction)
      val frame = at.frame.toFrame
      val secondLobes = MixedMaterial.scatter(second, at)
      at.frame.set(frame)
      Lobes.Builder()
        .addScaled(MixedMaterial.scatter(first, at), fraction)
        .addScaled(secondLobes, complement)
        .result

object MixedMaterial:
  private val clear = Passthrough(Rgb.White)

  private[composite] def complement(fraction: Rgb): Rgb = fraction.map(c => Math.max(1f - c, 0f))

  /** Within a blend, an interface is a transparent lobe, not the absence of a surface. */
  private[composite] def scatter(material: Material, at: ShadingPoint): Bsdf =
    if material.isInterface then clear else material.bsdf(at)

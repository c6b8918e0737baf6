package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.RgbTexture

/** A sheet that scatters to both sides, diffuse (`kd`) and glossy (`ks`); `reflect` and `transmit`
  * say how much of each stays on its side and how much passes. All are held to be ≥ 0.
  *
  * The gloss is a rough interface of index 1.5 (in PBRT 3), or a rough mirror of the same seen in
  * both directions (in PBRT 2).
  */
final class TranslucentMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    reflect: RgbTexture,
    transmit: RgbTexture,
    roughness: Roughness,
    edition: Edition
) extends Material:
  import TranslucentMaterial.*
  private val mirror = DielectricReflectance(1f / Index, oriented = false)

  def bsdf(at: ShadingPoint): Bsdf =
    val r = positive(reflect(at))
    val t = positive(transmit(at))
    val diffuse = positive(kd(at))
    val gloss = positive(ks(at))
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
  private def positive(c: Rgb): Rgb = c.map(x => Math.max(x, 0f))

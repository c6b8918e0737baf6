package candela.bsdf

import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture}

/** Diffuse reflection; Oren and Nayar's where `sigma` (degrees, held to [0, 90]) isn't 0. */
final class MatteMaterial(kd: RgbTexture, sigma: FloatTexture) extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val albedo = kd(at).map(c => Math.max(c, 0f))
    val angle = clamp(sigma(at), 0f, 90f)
    if angle == 0f then Lambert(albedo) else OrenNayar(albedo, angle)

/** Diffuse reflection; `reflectance` is held to [0, 1]. */
final class DiffuseMaterial(reflectance: RgbTexture) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = Lambert(reflectance(at).map(c => clamp(c, 0f, 1f)))

/** Diffuse scattering to both sides; textures times `scale` are held to [0, 1]. */
final class DiffuseTransmissionMaterial(
    reflectance: RgbTexture,
    transmittance: RgbTexture,
    scale: Float
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = DiffuseTransmission(
    reflectance(at).map(c => clamp(scale * c, 0f, 1f)),
    transmittance(at).map(c => clamp(scale * c, 0f, 1f))
  )

/** [[CoatedDiffuse]]; `reflectance` is held to [0, 1].
  *
  * @param family the coats of all roughnesses, if it varies; else a single one
  */
final class CoatedDiffuseMaterial(
    reflectance: RgbTexture,
    roughness: Roughness,
    family: IArray[Coat],
    baseHits: Int
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val top = roughness.trowbridgeReitz(at)
    val coat = if family.length == 1 then family(0) else Coats.between(family, top)
    CoatedDiffuse(reflectance(at).map(c => clamp(c, 0f, 1f)), top, coat, baseHits)
  override def isAnisotropic: Boolean = roughness.isAnisotropic

/** [[FresnelBlend]]: a glossy coat on a diffuse base. */
final class SubstrateMaterial(kd: RgbTexture, ks: RgbTexture, roughness: Roughness)
    extends Material:
  def bsdf(at: ShadingPoint): Bsdf = FresnelBlend(
    kd(at).map(c => Math.max(c, 0f)),
    ks(at).map(c => Math.max(c, 0f)),
    roughness(at)
  )
  override def isAnisotropic: Boolean = roughness.isAnisotropic

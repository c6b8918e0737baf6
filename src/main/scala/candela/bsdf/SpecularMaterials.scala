package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture}

/** A smooth mirror of the same reflectance at every angle. */
final class MirrorMaterial(kr: RgbTexture) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = Mirror(kr(at).map(c => Math.max(c, 0f)))

/** A metal. */
final class ConductorMaterial(metal: MetalTexture, roughness: Roughness) extends Material:
  def bsdf(at: ShadingPoint): Bsdf = Conductor(roughness(at), metal(at))
  override def isAnisotropic: Boolean = roughness.isAnisotropic

/** Glass, water: reflects and refracts.
  *
  * @param kr        multiplies the reflected light
  * @param kt        multiplies the refracted light
  * @param eta       index of refraction inside over that outside; 0 is taken for 1
  * @param roughness where it is not smooth, `compresses` must hold
  * @param compresses see [[SmoothDielectric]]
  */
final class DielectricMaterial(
    kr: RgbTexture,
    kt: RgbTexture,
    eta: FloatTexture,
    roughness: Roughness,
    compresses: Boolean
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val distribution = roughness(at)
    val raw = eta(at)
    val index = if raw == 0f then 1f else raw
    val reflectance = kr(at).map(c => Math.max(c, 0f))
    val transmittance = kt(at).map(c => Math.max(c, 0f))
    if compresses then Dielectric(distribution, index, reflectance, transmittance)
    else SmoothDielectric(index, reflectance, transmittance, compresses = false)
  override def isAnisotropic: Boolean = roughness.isAnisotropic

/** Which edition of PBRT's layered materials is meant. */
enum Edition:

  /** The interface of plastic and uber is the inside of glass, seen from either side: all light is
    * reflected beyond 42 degrees. Refraction doesn't change radiance.
    */
  case Second

  /** Plastic has the inside of glass outside (and the outside inside); uber is right. */
  case Third

/** Gloss on a diffuse base that doesn't know of it. */
final class PlasticMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    roughness: Roughness,
    edition: Edition
) extends Material:
  private val curve = DielectricReflectance(1f / 1.5f, oriented = edition == Edition.Third)

  def bsdf(at: ShadingPoint): Bsdf =
    val diffuse = kd(at).map(c => Math.max(c, 0f))
    val gloss = ks(at).map(c => Math.max(c, 0f))
    Lobes.Builder()
      .add(Lambert(diffuse), diffuse.max)
      .add(MicrofacetReflection(roughness(at), curve, gloss), gloss.max)
      .result

/** Everything at once: diffuse base, gloss, mirror, refraction, and `opacity` to see through it
  * all.
  */
final class UberMaterial(
    kd: RgbTexture,
    ks: RgbTexture,
    kr: RgbTexture,
    kt: RgbTexture,
    opacity: RgbTexture,
    eta: FloatTexture,
    roughness: Roughness,
    edition: Edition
) extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val third = edition == Edition.Third
    val index = if third then eta(at) else 1f / eta(at)
    val covered = opacity(at).map(c => Math.max(c, 0f))
    val open = (Rgb.White - covered).map(c => Math.max(c, 0f))
    val diffuse = kd(at).map(c => Math.max(c, 0f)) * covered
    val gloss = ks(at).map(c => Math.max(c, 0f)) * covered
    val mirror = kr(at).map(c => Math.max(c, 0f)) * covered
    val clear = kt(at).map(c => Math.max(c, 0f)) * covered
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
  override def isAnisotropic: Boolean = roughness.isAnisotropic

/** A rough and a smooth metal on top of each other, by their reflectances at normal incidence (PBRT
  * 2's "shinymetal"): each gets the index of refraction of the dielectric that reflects as much.
  */
final class ShinyMetalMaterial(ks: RgbTexture, kr: RgbTexture, roughness: Roughness)
    extends Material:
  def bsdf(at: ShadingPoint): Bsdf =
    val gloss = ks(at)
    val mirror = kr(at)
    Lobes.Builder()
      .add(MicrofacetReflection(roughness(at), ShinyMetalMaterial.curve(gloss)), gloss.max)
      .add(Mirror(Rgb.White, ShinyMetalMaterial.curve(mirror)), mirror.max)
      .result

object ShinyMetalMaterial:
  private[bsdf] def curve(reflectance: Rgb): ReflectanceCurve =
    val eta = reflectance.map: r =>
      val root = sqrt(clamp(r, 0f, 0.999f))
      (1f + root) / (1f - root)
    StrongConductorReflectance(eta, Rgb.Black)

package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture, Textured}

/** The interface of two transparent media, as rough as `distribution` says. */
object Dielectric:
  def apply(
      distribution: MicrofacetDistribution,
      eta: Float,
      reflectance: Rgb = Rgb.White,
      transmittance: Rgb = Rgb.White
  ): Bsdf =
    // With next to no change of index nothing is bent, however rough the interface: by 1e-4 at
    // most, and Float directions could not tell which facet did it.
    val isMatched = Math.abs(eta - 1f) < Matched
    if distribution.isSmooth || isMatched then SmoothDielectric(eta, reflectance, transmittance)
    else RoughDielectric(distribution, eta, reflectance, transmittance)

  /** Of the index: media that differ by less are as good as the same. */
  private inline val Matched = 1e-4f

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

object DielectricMaterial:

  /** That of PBRT 4. */
  def apply(eta: Float, roughness: Roughness): DielectricMaterial =
    new DielectricMaterial(White, White, ConstantFloat(eta), roughness)

  /** That of PBRT 2: always smooth, and refraction doesn't change radiance. */
  def old(kr: RgbTexture, kt: RgbTexture, eta: FloatTexture): DielectricMaterial =
    new DielectricMaterial(kr, kt, eta, Roughness.Smooth, compresses = false)

  private val White = ConstantRgb(Rgb.White)

/** A surface that scatters each wavelength in a way of its own.
  *
  * @param usual  what those see who don't ask for a wavelength
  * @param single what one wavelength, in nm, does
  */
final class Dispersive(usual: Bsdf, single: Float => Bsdf) extends WrappedBsdf(usual):
  override def isDispersive: Boolean = true
  override def atWavelength(nm: Float): Bsdf = single(nm)
  override def regularized: Bsdf = Dispersive(usual.regularized, nm => single(nm).regularized)

/** Glass that splits light into its colours.
  *
  * @param eta   index of refraction inside over that outside, by wavelength in nm
  * @param usual the one index for those who don't ask for a wavelength
  */
final class DispersiveMaterial(eta: Float => Float, usual: Float, roughness: Roughness)
    extends Material,
      Textured(roughness):
  override def isDispersive: Boolean = true

  def bsdf(at: ShadingPoint): Bsdf =
    val distribution = roughness(at)
    Dispersive(Dielectric(distribution, usual), nm => Dielectric(distribution, eta(nm)))

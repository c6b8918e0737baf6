package candela.bsdf.layered

import candela.bsdf.{Bsdf, Fresnel, Material}
import candela.bsdf.microfacet.Roughness
import candela.geometry.ShadingPoint
import candela.textures.{RgbTexture, Textured}

/** Mitsuba's `plastic` and `roughplastic`: a clear coat without thickness on a diffuse base.
  *
  * @param reflectance of the base; clamped to [0, 1]
  * @param specular    scale of the coat's reflection
  * @param nonlinear   whether light that the coat reflects back to the base is coloured by it again
  * @param roughness   of the coat; what it lets pass is that of the roughness at (0, 0)
  */
final class VarnishMaterial(
    reflectance: RgbTexture,
    specular: RgbTexture,
    nonlinear: Boolean,
    roughness: Roughness,
    eta: Float
) extends Material,
      Textured(reflectance, specular, roughness):
  private val usual = roughness(ShadingPoint())
  private val coat: Coat = if usual.isSmooth then SmoothCoat(eta, 0f) else RoughCoat(usual, eta, 0f)

  def bsdf(at: ShadingPoint): Bsdf =
    val albedo = reflectance.albedo(at)
    def series(under: Coat) =
      val back = reflected(under)
      albedo.map(c => c / (1f - back * (if nonlinear then c else 1f)))
    new CoatedDiffuse(series, roughness(at), coat, specular.positive(at))

  /** Of light from the base. Under rough coats Mitsuba takes the mean of 64 cosines, both ends
    * included, so that the reflectance at normal incidence counts too much.
    */
  private def reflected(under: Coat): Float =
    val mean = under.internalReflectance
    if usual.isSmooth then mean else (63f * mean + Fresnel.dielectric(1f, eta)) / 64f

package candela.bsdf.layered

import candela.bsdf.{Bsdf, Fresnel, Material}
import candela.bsdf.microfacet.Roughness
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{RgbTexture, Textured}

/** What becomes of light that the coat reflects back to the base. */
enum Varnish:
  /** The base reflects it as if it were white. */
  case Plain

  /** The base colours it again. */
  case Colored

  /** It is lost, and the coat lets light pass as a smooth one does. */
  case Once

/** Mitsuba's `plastic`, `roughplastic` and `pplastic`, the last for unpolarized light: a clear coat
  * without thickness on a diffuse base.
  *
  * @param reflectance of the base; clamped to [0, 1]
  * @param specular    scale of the coat's reflection
  * @param roughness   of the coat; what it lets pass is that of the roughness at (0, 0)
  */
final class VarnishMaterial(
    reflectance: RgbTexture,
    specular: RgbTexture,
    under: Varnish,
    roughness: Roughness,
    eta: Float,
    coats: Coats
) extends Material,
      Textured(reflectance, specular, roughness):
  private val reference = roughness(ShadingPoint())
  private val coat: Coat =
    coats.clear(if under == Varnish.Once then Roughness.Smooth else roughness, eta)

  def bsdf(at: ShadingPoint): Bsdf =
    val albedo = reflectance.albedo(at)
    CoatedDiffuse(Series(albedo), roughness(at), coat, specular.positive(at), albedo)

  private final class Series(albedo: Rgb) extends BaseSeries:
    def full(coat: Coat): Rgb = under match
      case Varnish.Plain =>
        val internal = reflected(coat)
        albedo.map(_ / (1f - internal))
      case Varnish.Colored =>
        val internal = reflected(coat)
        albedo.map(c => c / (1f - internal * c))
      // Light that leaves is spread by the factor η², which Mitsuba leaves out here
      case Varnish.Once => albedo * (eta * eta)

  /** Of light from the base. Under smooth coats Mitsuba takes fits. Under rough ones it takes the
    * mean of 64 cosines, both ends included, so that the reflectance at normal incidence counts too
    * much.
    */
  private def reflected(coat: Coat): Float =
    if reference.isSmooth then
      val fitted = VarnishMaterial.fittedReflectance(eta)
      // Beyond an index of 4.3, Mitsuba's surfaces take light away
      if fitted < 1f then fitted else coat.internalReflectance
    else (63f * coat.internalReflectance + Fresnel.dielectric(1f, eta)) / 64f

object VarnishMaterial:

  /** Of diffuse light from within: up to 10 % too much for indices above 2.
    *
    * Sources: Egan and Hilgeman, "Spectral Polarization of Diffuse Reflection", 1973, from the
    * denser side; d'Eon and Irving, "A Quantized-Diffusion Model for Rendering Translucent
    * Materials", SIGGRAPH 2011, from the thinner one.
    */
  private def fittedReflectance(eta: Float): Float =
    val n = 1f / eta
    if n < 1f then ((-1.4399f * n + 0.7099f) * n + 0.6681f) + 0.0636f * eta
    else
      val coefficients = Array(-1.36881f, 4.98554f, -7.80989f, 6.75335f, -3.4793f, 0.919317f)
      coefficients.reduce((sum, c) => sum * eta + c)

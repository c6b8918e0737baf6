package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured}

/** Diffuse reflection by V-shaped grooves, with masking, shadowing and interreflection: the full
  * model of which [[OrenNayar]] is an approximation.
  *
  * @param albedo reflectance of the microfacets, in [0, 1]
  * @param sigma  standard deviation of the microfacet angle, in radians
  *
  * Source: Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, §4.3.
  */
final class RoughDiffuse(albedo: Rgb, sigma: Float) extends CosineSampled:
  private val variance = square(sigma)
  private val direct = 1f - 0.5f * variance / (variance + 0.33f)
  private val opposite = variance / (variance + 0.09f)
  private val twice = 0.17f * variance / (variance + 0.13f)

  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val (cosO, cosI) = (Math.min(Hemisphere.absCos(wo), 1f), Math.min(Hemisphere.absCos(wi), 1f))
    val (steep, level) = if cosO > cosI then (cosO, cosI) else (cosI, cosO)
    val (beta, alpha) = (Math.acos(steep).toFloat, Math.acos(level).toFloat)
    val (sinBeta, sinAlpha) = (safeSqrt(1f - steep * steep), safeSqrt(1f - level * level))
    val sines = sinAlpha * sinBeta
    val cosPhi = if sines > 1e-7f then clamp((wo.x * wi.x + wo.y * wi.y) / sines, -1f, 1f) else 0f
    val share = 2f * beta * InvPi
    val lean = if cosPhi > 0f then sinAlpha else sinAlpha - share * share * share
    val grazing = square(4f * InvPi * InvPi * alpha * beta)
    val singleBounce = direct + cosPhi * 0.45f * opposite * lean * sinBeta / steep +
      (1f - Math.abs(cosPhi)) * 0.125f * opposite * grazing * (sinAlpha + sinBeta) / (level + steep)
    val doubleBounce = twice * (1f - cosPhi * share * share)
    // The fit may be below 0 where both are grazing
    albedo.map(c => c * Math.max(0f, singleBounce + c * doubleBounce) * InvPi)

/** [[RoughDiffuse]], or its approximation.
  *
  * @param alpha roughness as of microfacets: √2 times the standard deviation of their angles, in
  *              radians
  */
final class RoughDiffuseMaterial(reflectance: RgbTexture, alpha: FloatTexture, isFast: Boolean)
    extends Material,
      Textured(reflectance, alpha):
  def bsdf(at: ShadingPoint): Bsdf =
    val albedo = reflectance.albedo(at)
    val sigma = Math.max(alpha(at), 0f) / sqrt(2f)
    if isFast then OrenNayar(albedo, Math.toDegrees(sigma).toFloat) else RoughDiffuse(albedo, sigma)

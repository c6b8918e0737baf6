package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{FloatTexture, RgbTexture, Textured}

/** Diffuse reflection by V-shaped grooves, as of clay or the moon.
  *
  * @param albedo reflectance of the microfacets, in [0, 1]
  * @param sigma  standard deviation of the microfacet angle, in degrees, in [0, 90]; 0 is
  *               [[Lambert]]
  *
  * Source: Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994: the
  * qualitative model.
  */
final class OrenNayar(albedo: Rgb, sigma: Float) extends LeanBsdf:
  private val variance = square(radians(sigma))
  private val a = 1f - variance / (2f * (variance + 0.33f))
  private val b = 0.45f * variance / (variance + 0.09f)

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isSameSide(wo, wi) then albedo * (InvPi * shape(wo, wi)) else Rgb.Black

  /** The value relative to a Lambertian surface. */
  private def shape(wo: Vec3, wi: Vec3): Float =
    val cosO = Hemisphere.absCos(wo)
    val cosI = Hemisphere.absCos(wi)
    // sin α · tan β · cos Δφ: the sines cancel those of the azimuths, leaving one cosine.
    val projected = wo.x * wi.x + wo.y * wi.y
    if projected <= 0f then a else a + b * projected / (if cosI > cosO then cosI else cosO)

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isSameSide(wo, wi) then Hemisphere.cosinePdf(wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi = Hemisphere.cosineSample(wo, u1, u2)
    if !Hemisphere.isSameSide(wo, wi) then out.absorb()
    else out.set(wi, albedo * shape(wo, wi), Hemisphere.cosinePdf(wi), isSpecular = false)

  def flags: BsdfFlags = BsdfFlags.Diffuse

/** Diffuse reflection; [[OrenNayar]] where `sigma` (degrees, clamped to [0, 90]) is not 0. */
final class MatteMaterial(kd: RgbTexture, sigma: FloatTexture)
    extends Material,
      Textured(kd, sigma):
  def bsdf(at: ShadingPoint): Bsdf =
    val albedo = kd.positive(at)
    val angle = clamp(sigma(at), 0f, 90f)
    if angle == 0f then Lambert(albedo) else OrenNayar(albedo, angle)

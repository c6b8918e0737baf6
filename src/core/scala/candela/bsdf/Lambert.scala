package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{RgbTexture, Textured}

import scala.annotation.unused

/** Ideal diffuse reflection: constant radiance in the hemisphere of the light.
  *
  * @param albedo reflected fraction of the power, in [0, 1]; Mitsuba's surfaces may add light
  */
final class Lambert(albedo: Rgb) extends LeanBsdf:
  private val value = albedo * InvPi
  private val absorbs = albedo.isBlack

  def f(wo: Vec3, wi: Vec3): Rgb = if Hemisphere.isSameSide(wo, wi) then value else Rgb.Black

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !absorbs && Hemisphere.isSameSide(wo, wi) then Hemisphere.cosinePdf(wi) else 0f

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val wi = Hemisphere.cosineSample(wo, u1, u2)
    if absorbs || !Hemisphere.isSameSide(wo, wi) then out.absorb()
    else out.set(wi, albedo, Hemisphere.cosinePdf(wi), isSpecular = false)

  override def diffuseReflectance(@unused wo: Vec3): Rgb = albedo
  def flags: BsdfFlags = BsdfFlags.Diffuse

object Lambert:
  /** Scatters nothing. */
  val Black: Lambert = new Lambert(Rgb.Black)

/** [[Lambert]]; `reflectance` is at least 0 and, unless `gains`, at most 1. */
final class DiffuseMaterial(reflectance: RgbTexture, gains: Boolean = false)
    extends Material,
      Textured(reflectance):
  def bsdf(at: ShadingPoint): Bsdf =
    Lambert(if gains then reflectance.positive(at) else reflectance.albedo(at))

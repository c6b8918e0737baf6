package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{RgbTexture, Textured}

/** Ideal diffuse reflection and transmission by a thin sheet, such as paper or a leaf.
  *
  * The side is sampled in proportion to the largest components.
  *
  * @param reflectance   reflected fraction of the power, in [0, 1]
  * @param transmittance transmitted fraction of the power; the sum of both should not exceed 1
  */
final class DiffuseTransmission(reflectance: Rgb, transmittance: Rgb) extends LeanBsdf:
  private val total = reflectance.max + transmittance.max
  private val reflects = if total > 0f then reflectance.max / total else 0f
  private val transmits = if total > 0f then transmittance.max / total else 0f

  def f(wo: Vec3, wi: Vec3): Rgb =
    val cosines = wo.z * wi.z
    if cosines > 0f then reflectance * InvPi
    else if cosines < 0f then transmittance * InvPi
    else Rgb.Black

  def pdf(wo: Vec3, wi: Vec3): Float =
    val cosines = wo.z * wi.z
    val side = if cosines > 0f then reflects else if cosines < 0f then transmits else 0f
    side * Hemisphere.cosinePdf(wi)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val reflected = Hemisphere.cosineSample(wo, u1, u2)
    if total == 0f || !Hemisphere.isSameSide(wo, reflected) then out.absorb()
    else if choice < reflects then
      val density = reflects * Hemisphere.cosinePdf(reflected)
      out.set(reflected, reflectance * (1f / reflects), density, isSpecular = false)
    else
      val transmitted = Hemisphere.flipped(reflected)
      val density = transmits * Hemisphere.cosinePdf(transmitted)
      out.set(transmitted, transmittance * (1f / transmits), density, isSpecular = false)

  val flags: BsdfFlags =
    val common = BsdfFlags.Diffuse | BsdfFlags.Choosing
    if transmittance.isBlack then common else common | BsdfFlags.Transmissive

/** [[DiffuseTransmission]]; textures times `scale` are clamped to [0, 1]. */
final class DiffuseTransmissionMaterial(
    reflectance: RgbTexture,
    transmittance: RgbTexture,
    scale: Float
) extends Material,
      Textured(reflectance, transmittance):
  def bsdf(at: ShadingPoint): Bsdf = DiffuseTransmission(
    reflectance(at).map(c => clamp(scale * c, 0f, 1f)),
    transmittance(at).map(c => clamp(scale * c, 0f, 1f))
  )

package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** A surface that scatters each wavelength in a way of its own.
  *
  * @param usual  what those see who don't ask for a wavelength
  * @param single what one wavelength, in nm, does
  */
final class Dispersive(usual: Bsdf, single: Float => Bsdf) extends Bsdf:
  def at(wavelength: Float): Bsdf = single(wavelength)

  def f(wo: Vec3, wi: Vec3): Rgb = usual.f(wo, wi)
  def pdf(wo: Vec3, wi: Vec3): Float = usual.pdf(wo, wi)
  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    usual.sample(wo, choice, u1, u2)
  def isSpecular: Boolean = usual.isSpecular
  def isTransmissive: Boolean = usual.isTransmissive

/** Glass that splits light into its colours.
  *
  * @param eta   index of refraction inside over that outside, by wavelength in nm
  * @param usual the one index for those who don't ask for a wavelength
  */
final class DispersiveMaterial(eta: Float => Float, usual: Float, roughness: Roughness)
    extends Material:
  override def isDispersive: Boolean = true
  override def isAnisotropic: Boolean = roughness.isAnisotropic

  def bsdf(at: ShadingPoint): Bsdf =
    val distribution = roughness(at)
    Dispersive(Dielectric(distribution, usual), nm => Dielectric(distribution, eta(nm)))

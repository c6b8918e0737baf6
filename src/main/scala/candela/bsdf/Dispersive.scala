package candela.bsdf

import candela.geometry.ShadingPoint

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
    extends Material:
  override def isDispersive: Boolean = true
  override def isAnisotropic: Boolean = roughness.isAnisotropic

  def bsdf(at: ShadingPoint): Bsdf =
    val distribution = roughness(at)
    Dispersive(Dielectric(distribution, usual), nm => Dielectric(distribution, eta(nm)))

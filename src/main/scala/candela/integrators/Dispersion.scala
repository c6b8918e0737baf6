package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.sampling.{Sampler, Wavelengths}

/** Which wavelength a path has, once it has met a surface that splits light. Mutable; one for each
  * worker.
  */
final class Dispersion(wavelengths: Wavelengths):

  // In nm; 0: the path has all of them
  private var wavelength = 0f

  /** By which the path's colour changed where `choose` was asked last. */
  var weight: Rgb = Rgb.White

  /** A new path sets out. */
  def begin(): Unit = wavelength = 0f

  /** What the path sees of the surface. */
  def choose(met: Bsdf, sampler: Sampler): Bsdf =
    weight = Rgb.White
    if !met.isDispersive then met
    else
      if wavelength == 0f then
        val u = sampler.next1D()
        wavelength = wavelengths.sample(u)
        weight = wavelengths.weight(u)
      met.atWavelength(wavelength)

package candela.integrators

import candela.bsdf.Bsdf
import candela.color.Rgb
import candela.sampling.{Sampler, Wavelengths}

/** The wavelength of a path, sampled at its first dispersive surface. Mutable, one per worker. */
final class Dispersion(wavelengths: Wavelengths):

  // In nm; 0: the path still carries all wavelengths
  private var wavelength = 0f

  /** Factor of the throughput from the last [[choose]]. */
  var weight: Rgb = Rgb.White

  /** Starts a new path. */
  def begin(): Unit = wavelength = 0f

  /** The BSDF for the path's wavelength, sampled now if `bsdf` is the first dispersive one. */
  def choose(bsdf: Bsdf, sampler: Sampler): Bsdf =
    weight = Rgb.White
    if !bsdf.isDispersive then bsdf
    else
      if wavelength == 0f then
        val u = sampler.next1D()
        wavelength = wavelengths.sample(u)
        weight = wavelengths.weight(u)
      bsdf.atWavelength(wavelength)

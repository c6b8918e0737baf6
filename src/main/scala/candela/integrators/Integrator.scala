package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.Sampler

/** Estimates the radiance that arrives along a ray. One object for each worker (it owns mutable
  * work space); `copy` makes the next worker's.
  */
abstract class Integrator:
  def radiance(ray: Ray, sampler: Sampler): Rgb
  def copy(): Integrator

  /** Do its paths take a wavelength where light is split? */
  def splitsLight: Boolean = false

  /** Rays traced so far by this worker, for the statistics. */
  def raysTraced: Long

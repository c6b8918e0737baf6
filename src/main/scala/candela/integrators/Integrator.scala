package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.Sampler
import candela.scene.PathReport

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

  /** The number of the material that was met last, −1: unknown. Says where a bad sample is from. */
  def lastMaterial: Int = -1

  /** A copy that tells `report` what it does. */
  def reported(report: PathReport): Integrator

package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.sampling.Sampler
import candela.scene.{PathReport, Scene}

/** Estimates the radiance that arrives along a ray. One object per worker, as it owns mutable work
  * space; `copy` makes the next worker's.
  */
abstract class Integrator:
  def radiance(ray: Ray, sampler: Sampler): Rgb
  def copy(): Integrator

  /** Do its paths keep one wavelength where a surface disperses light? */
  def splitsLight: Boolean = false

  /** Rays traced so far by this worker, for the statistics. */
  def raysTraced: Long

  /** Index of the material that was hit last, −1: unknown. Says where a bad sample comes from. */
  def lastMaterial: Int = -1

  /** A copy that reports to `report` what it does. */
  def reported(report: PathReport): Integrator

/** An [[Integrator]] whose copies differ in the scene alone. */
abstract class SceneIntegrator(scene: Scene) extends Integrator:
  protected def over(scene: Scene): Integrator
  final def copy(): Integrator = over(scene)
  final def reported(report: PathReport): Integrator = over(scene.reported(report))

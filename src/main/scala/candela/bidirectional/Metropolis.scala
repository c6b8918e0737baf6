package candela.bidirectional

import candela.color.Rgb
import candela.geometry.Ray
import candela.integrators.{Chained, Chains, Integrator, Splats, View}
import candela.cameras.Camera
import candela.sampling.Sampler
import candela.scene.PathReport

/** How chains walk.
  *
  * @param bootstrap paths from which the mean brightness is known and the chains start
  * @param chains    that walk independently
  * @param largeStep probability of a path that is all new
  * @param sigma     standard deviation of each random number in the other steps
  */
final case class MetropolisSettings(
    bootstrap: Int,
    chains: Int,
    largeStep: Float,
    sigma: Float,
    seed: Int = 0
)

/** Metropolis light transport in the space of random numbers: chains of paths, each a small change
  * of the last or all new, that come to each path as often as it is bright. The paths are those of
  * [[BidirectionalPathTracer]], which makes one picture of one sequence of random numbers; so where
  * light is hard to find, what has been found is explored.
  *
  * Sources: Veach and Guibas, "Metropolis Light Transport", SIGGRAPH 1997; Kelemen et al., see
  * [[PrimarySamples]]; PBRT 3rd ed., §16.4.
  */
final class Metropolis(paths: BidirectionalPathTracer, settings: MetropolisSettings)
    extends Integrator
    with Chained:

  def chains(view: View): Chains = MarkovChains(paths, settings, view)

  def aim(camera: Camera, splats: Splats | Null): Unit = paths.aim(camera, splats)

  /** As if there were no chains. */
  def radiance(ray: Ray, sampler: Sampler): Rgb = paths.radiance(ray, sampler)

  def raysTraced: Long = paths.raysTraced
  override def lastMaterial: Int = paths.lastMaterial
  def copy(): Integrator = Metropolis(paths.another(), settings)
  def reported(report: PathReport): Integrator = Metropolis(paths.telling(report), settings)

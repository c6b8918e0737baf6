package candela.bdpt

import candela.color.{Rgb, Wavelengths}
import candela.geometry.Ray
import candela.integrators.SpectralIntegrator
import candela.sampling.Sampler

/** Paths as a function of primary samples, which [[MarkovChains]] explore. Mutable, one per worker.
  */
trait ChainPaths:
  /** Radiance along a camera ray.
    *
    * @param light  samples the light subpath and its connections to the camera
    * @param joins  samples the connections of camera vertices to lights
    * @param onward samples the continuation of the camera subpath
    */
  def radiance(ray: Ray, light: Sampler, joins: Sampler, onward: Sampler): Rgb

  def raysTraced: Long
  def lastMaterial: Int

/** Paths of several sets of wavelengths, chosen by a primary sample.
  *
  * @param paths of each basis
  */
final class SpectralChainPaths(paths: Array[ChainPaths], bases: Array[Wavelengths])
    extends ChainPaths:
  private var last = paths(0)

  def radiance(ray: Ray, light: Sampler, joins: Sampler, onward: Sampler): Rgb =
    val i = SpectralIntegrator.choose(onward.next1D(), bases.length)
    last = paths(i)
    bases(i).toSrgb(last.radiance(ray, light, joins, onward))

  def raysTraced: Long = paths.iterator.map(_.raysTraced).sum
  def lastMaterial: Int = last.lastMaterial

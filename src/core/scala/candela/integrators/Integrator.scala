package candela.integrators

import candela.io.{CheckedInput, CheckedOutput}
import candela.aov.LightParts
import candela.color.{Rgb, Wavelengths}
import candela.geometry.Ray
import candela.sampling.Sampler
import candela.scene.{PathReport, Scene}

/** Estimates the radiance that arrives along a ray. One object per worker, as it owns mutable work
  * space; [[WorkerIntegrators]] make them.
  */
abstract class Integrator:
  def radiance(ray: Ray, sampler: Sampler): Rgb

  /** Wavelengths of the last radiance, and the radiance at these; null: it has none. */
  def lastWavelengths: Wavelengths | Null = null
  def lastComponents: Rgb = Rgb.Black

  /** The last radiance, divided; null: the scene doesn't ask for it, or the integrator can't. */
  def lightParts: LightParts | Null = null

  /** Rays traced so far by this worker, for the statistics. */
  def raysTraced: Long

  /** Index of the material that was hit last, −1: unknown. Says where a bad sample comes from. */
  def lastMaterial: Int = -1

/** Makes the integrators of a rendering, one for each worker. */
abstract class WorkerIntegrators:
  /** @param report receives what the integrator does, if given */
  def create(report: Option[PathReport]): Integrator

  /** Whether they divide their light as the scene asks; see [[Integrator.lightParts]]. */
  def divideLight: Boolean

object WorkerIntegrators:
  /** Integrators that differ in their scratch memory alone. */
  def apply(scene: Scene)(integrator: Scene => Integrator): WorkerIntegrators =
    new WorkerIntegrators:
      def create(report: Option[PathReport]): Integrator =
        integrator(report.fold(scene)(scene.reported))

      lazy val divideLight: Boolean =
        scene.lightGroups.isDefined && create(None).lightParts != null

/** The passes of one rendering, shared by all workers: sample k of every pixel uses what pass k has
  * prepared. At most [[SharedPasses.MaxOpen]] passes are in use at a time.
  */
abstract class SharedPasses:
  /** The integrator of one worker, reporting its path if a report is given. */
  def integrator(report: Option[PathReport]): PassIntegrator

  /** Forgets a pass that no worker uses any more. */
  def release(pass: Int): Unit

object SharedPasses:
  /** Two passes are in use, so that no worker waits at the end of a pass. */
  inline val MaxOpen = 2

/** Estimates radiance with what a pass has prepared. */
trait PassIntegrator extends Integrator:
  /** Starts the samples with this index; false if stopped before it is prepared. */
  def startPass(pass: Int, isStopped: () => Boolean): Boolean

/** The Markov chains of one rendering, shared by all workers. They write to the film's
  * [[candela.film.Splats]] only.
  */
abstract class SharedChains:
  def count: Int

  /** Scratch memory of one worker. */
  def walker(): ChainWalker

  /** Writes the state of all chains; none may be advanced meanwhile. */
  def save(to: CheckedOutput): Unit

  /** Continues the saved chains; others stay as they are. */
  def load(from: CheckedInput): Unit

  /** Splats the current path of a chain that was left, and is not continued. */
  def settle(chain: Int, weight: Float): Unit

/** Advances chains; mutable, one per worker. A chain may move from one worker to another, but is
  * never advanced by two at a time.
  */
abstract class ChainWalker:
  /** Prepares, together with the other workers, what all chains need before they advance; false if
    * stopped on the way.
    */
  def prepare(isStopped: () => Boolean): Boolean

  /** Advances a chain by `paths` mutations, unless it is left on the way.
    *
    * @param weight [[pending]] when the chain was left before; 0 if it was not
    * @return how many have been made
    */
  def advance(chain: Int, paths: Long, weight: Float, isLeft: () => Boolean): Long

  /** Weight of the current path of the chain that was left last, not splatted yet. */
  def pending: Float

  /** Pixel of the last proposed path. */
  def x: Int
  def y: Int

  /** Number of discarded paths, whose radiance was NaN or infinite. */
  def discarded: Long
  def raysTraced: Long
  def lastMaterial: Int

package candela.integrators

import candela.scene.PathReport

/** The passes of one rendering, shared by all workers: samples of one number gather what the pass
  * of that number has prepared. At most [[SharedPasses.Open]] passes are in use at a time.
  */
abstract class SharedPasses:
  /** The integrator of one worker, which may report what it does. */
  def integrator(report: Option[PathReport]): PassIntegrator

object SharedPasses:
  /** The pass that is nearly done, and the next: no worker has to wait at the end of each pass. */
  inline val Open = 2

/** Estimates radiance with what a pass has prepared. */
trait PassIntegrator extends Integrator:
  /** The samples that follow are those of this number. */
  def begin(pass: Int): Unit

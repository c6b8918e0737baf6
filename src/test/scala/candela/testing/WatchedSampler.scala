package candela.testing

import candela.render.RenderPlan
import candela.sampling.Sampler

/** A sampler that tells of each sample before it starts.
  *
  * @param starts called with the pixel and the number of the sample
  */
final class WatchedSampler(inner: Sampler, starts: (Int, Int, Int) => Unit) extends Sampler:
  def samplesPerPixel: Int = inner.samplesPerPixel
  def copy(): Sampler = WatchedSampler(inner.copy(), starts)
  def start(px: Int, py: Int, sample: Int): Unit =
    starts(px, py, sample)
    inner.start(px, py, sample)
  def next1D(): Float = inner.next1D()
  def next2D(): Unit =
    inner.next2D()
    x = inner.x
    y = inner.y

object WatchedSampler:
  /** The plan, with its sampler watched. */
  def watched(plan: RenderPlan)(starts: (Int, Int, Int) => Unit): RenderPlan =
    RenderPlan(
      plan.width,
      plan.height,
      plan.crop,
      plan.camera,
      plan.filter,
      WatchedSampler(plan.sampler, starts),
      plan.method,
      plan.basis,
      plan.limit,
      plan.development,
      plan.filename,
      plan.features
    )

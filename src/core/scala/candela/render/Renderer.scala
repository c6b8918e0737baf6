package candela.render

import candela.color.Rgb
import candela.scene.PathReport

/** Renders a plan to an image. */
object Renderer:

  /** Renders with `threads` workers, to the last planned sample. */
  def render(plan: RenderPlan, threads: Int): Rendering =
    render(plan, RenderControl(threads))

  /** Renders a plan. The image is deterministic, bit-identical for any number of threads: sums are
    * exact, or of one tile, which adds its samples in order.
    *
    * @throws RenderFailure if a sample fails; all workers then stop
    * @throws candela.diagnostics.SceneError if a file of the scene can't be read any more; likewise
    */
  def render(plan: RenderPlan, control: RenderControl): Rendering =
    RenderLoop(plan, control).run()

  /** The image of a saved state, or of several that add up to one.
    *
    * @param load loads them
    */
  def gather(plan: RenderPlan, load: RenderState => Unit): Rendering =
    val job = plan.method.job(plan, Shard.Whole)
    val state = RenderState(job, TaskQueue(job.schedule, Cancellation()), Vector.empty)
    load(state)
    state.settle()
    state.rendering(state.samplesDone)

  /** Traces a single sample, identical to that of [[render]], and reports its path to `report`.
    *
    * @return its light as accumulated by the film; none if it was discarded
    */
  def trace(plan: RenderPlan, x: Int, y: Int, sample: Int, report: PathReport): Option[Rgb] =
    val (film, worker) = Job.single(plan, x, y, report)
    worker.traceSample(x, y, sample)
    val data = film.toImage(1f).data
    Option.when(worker.discarded.isEmpty)(Rgb(data(0), data(1), data(2)))

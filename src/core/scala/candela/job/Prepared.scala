package candela.job

import candela.diagnostics.Problem
import candela.build.BuiltScene
import candela.color.Rgb
import candela.render.{
  Checkpointer, RenderControl, Renderer, Rendering, RenderPlan, RenderState, ThreadPool
}
import candela.render.storage.{FilmHeader, FilmWriter}
import candela.scene.PathReport
import candela.scenefile.SceneDescription
import candela.settings.RenderSettings

import java.nio.file.Path

/** A scene that is ready to be rendered: a job of its own, beside which others may be prepared and
  * rendered in one process. Its threads end when it is closed.
  *
  * @param warnings of reading and building
  * @param settings it was prepared by
  * @param pool     of its threads
  * @param built    plans it for other cameras
  */
final case class Prepared(
    description: SceneDescription,
    plan: RenderPlan,
    warnings: Vector[Problem],
    readSeconds: Double = 0,
    buildSeconds: Double = 0,
    pool: ThreadPool = ThreadPool(1),
    settings: RenderSettings = RenderSettings(),
    built: Option[BuiltScene] = None
) extends AutoCloseable:
  def close(): Unit = pool.close()

  /** Number of missing items replaced by placeholders. */
  def standIns: Int = warnings.distinct.count(_.standIn.nonEmpty)

  /** Traces a single sample, identical to that of [[Render.render]].
    *
    * @return its light; none if it was discarded
    */
  def trace(x: Int, y: Int, sample: Int, report: PathReport): Option[Rgb] =
    Renderer.trace(plan, x, y, sample, report)

  /** Renders a part of the samples to a film file.
    *
    * @param header of the whole
    */
  def shard(header: FilmHeader, to: Path, control: RenderControl): Rendering =
    val assigned = control.shard
    val keeper = new Checkpointer:
      def restore(state: RenderState): Unit = ()
      def isDue: Boolean = false
      def save(state: RenderState): Unit =
        Prepared.write(header.of(Set(assigned.index), assigned.count, state), state, to)
      def discard(): Unit = ()
      def finish(): Unit = ()
    Render.render(this, control.copy(checkpointer = Some(keeper)))

  /** The sum of saved states.
    *
    * @param load loads them
    */
  def gather(load: RenderState => Unit): Rendering = Renderer.gather(plan, load)

object Prepared:
  /** Writes a film file. */
  def write(header: FilmHeader, state: RenderState, to: Path): Unit =
    val writer = FilmWriter(to)
    writer.write(header, state)
    writer.commit()

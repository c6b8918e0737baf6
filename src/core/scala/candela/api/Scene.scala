package candela.api

import candela.base.{Code, SceneError, Severity as Grade}
import candela.job.{Prepared, SceneLoader}
import candela.scenefile.SceneDescription

import java.nio.file.Path
import java.util.List as JList

import scala.jdk.CollectionConverters.*

/** A scene as it was read or made, before its shapes, textures and lights are built. Immutable, and
  * safe to use from several threads.
  */
final class Scene private[api] (
    val name: String,
    private[api] val description: Option[SceneDescription],
    private val found: Vector[candela.base.Problem],
    private[api] val how: ReadSettings
):
  /** What is wrong with it, as far as reading tells; [[check]] tells all. Empty if nothing is. */
  def problems: JList[Problem] = Problems.ofCore(found)

  /** Whether an error keeps it from being rendered. */
  def hasErrors: Boolean = found.exists(_.severity == Grade.Error)

  /** `v2`, `v3` or `v4` of pbrt, or `mitsuba`; empty if it could not be read. */
  def dialect: String = description.fold("")(_.dialect.toString.toLowerCase)

  /** The scene file, and those that it includes; empty if it is not from a file. */
  def files: JList[Path] = java.util.List.copyOf(description.fold(Vector.empty)(_.sources).asJava)

  /** Builds all of it, by as many threads as there are processors.
    *
    * @throws SceneException if it has errors
    */
  def prepare(settings: RenderSettings): Job =
    prepare(settings, Runtime.getRuntime.availableProcessors)

  /** Builds all of it: meshes are read, textures loaded, the acceleration structure made.
    *
    * @param threads that build it, at least 1
    * @throws SceneException if it has errors
    */
  def prepare(settings: RenderSettings, threads: Int): Job =
    if threads < 1 then
      Problems.fail(Code.OptionValue, s"`threads` must be at least 1, found $threads")
    Job(this, settings, Problems.thrown(prepared(settings, threads, isRendered = true)))

  /** All that is wrong with it, its files included: builds it, and throws the result away. */
  def check(settings: RenderSettings): JList[Problem] =
    try
      val threads = Runtime.getRuntime.availableProcessors
      val ready = Problems.thrown(prepared(settings, threads, isRendered = false))
      ready.close()
      Problems.ofCore(ready.warnings)
    catch case e: SceneException => e.problems

  /** Begins another scene that has all of this one, to which statements are added. */
  def edit(): SceneBuilder =
    val base = readable
    SceneBuilder(name, base.folder, Some(this))

  /** @throws SceneError if there is nothing */
  private def readable: SceneDescription = description.getOrElse(throw SceneException(found))

  private def prepared(settings: RenderSettings, threads: Int, isRendered: Boolean): Prepared =
    val known = description.getOrElse(throw SceneError(found))
    val reading = how.of.settings.reading
    val all = settings.of.copy(reading = reading)
    val to = how.of.copy(settings = all, threads = threads, isRendered = isRendered)
    SceneLoader.refusing(SceneLoader.built(known, to))

private[api] object Scenes:

  /** What `body` reads. */
  def read(name: String, how: ReadSettings)(body: => SceneDescription): Scene =
    try of(name, body, how)
    catch case e: SceneError => Scene(name, None, e.problems, how)

  def of(name: String, description: SceneDescription, how: ReadSettings): Scene =
    Scene(name, Some(description), description.errors ++ description.warnings, how)

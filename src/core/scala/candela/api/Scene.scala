package candela.api

import candela.diagnostics.{Code, SceneError, Severity as Grade}
import candela.image.Oidn
import candela.job.{Prepared, Render}
import candela.scenefile.{MaterialRef, SceneDescription}

import java.nio.file.Path
import java.util.{List as JList, Locale, Objects}

import scala.jdk.CollectionConverters.*

/** A parsed scene, before its shapes, textures and lights are built. Immutable and thread-safe.
  */
final class Scene private[api] (
    val name: String,
    private[api] val description: Option[SceneDescription],
    private val readProblems: Vector[candela.diagnostics.Problem],
    private[api] val reading: ReadSettings,
    private val isBuilt: Boolean = false
):
  private lazy val coreProblems: Vector[candela.diagnostics.Problem] =
    if isBuilt then checked(RenderSettings()) else readProblems

  /** Errors and warnings: of a file or a text, those of reading it, and [[check]] returns all; of a
    * scene built or edited in code, all.
    *
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted, and
    *                                                    the scene was built or edited
    */
  def problems: JList[Problem] = Problems.ofCore(coreProblems)

  /** Whether errors prevent rendering, as far as [[problems]] has them. */
  def hasErrors: Boolean = coreProblems.exists(_.severity == Grade.Error)

  /** The shapes, each in a few words, for edits by their indices; those of objects, which instances
    * place, are not among them.
    */
  def shapes: JList[String] =
    listed(_.shapes): s =>
      val material = s.material match
        case MaterialRef.Default => ""
        case MaterialRef.Named(name, _) => s"material $name"
        case MaterialRef.Inline(m) => s"material of type ${m.name}"
      Vector(s"${s.shape.name} of ${s.shape.pos}", material) ++ s.areaLight.map(_ => "area light")

  /** The lights but area lights, each in a few words, for edits by their indices. */
  def lights: JList[String] = listed(_.lights)(l => Vector(s"${l.light.name} of ${l.light.pos}"))

  private def listed[A](all: SceneDescription => Vector[A])(words: A => Vector[String]) =
    val texts = description.fold(Vector.empty)(all).map(words(_).filter(_.nonEmpty).mkString(", "))
    java.util.List.copyOf(texts.asJava)

  /** `v2`, `v3` or `v4` of pbrt, or `mitsuba`; empty if it could not be read. */
  def dialect: String = description.fold("")(_.dialect.toString.toLowerCase(Locale.ROOT))

  /** The scene file and its includes; empty if it is not from a file. */
  def files: JList[Path] = java.util.List.copyOf(description.fold(Vector.empty)(_.sources).asJava)

  /** Builds the scene with one thread per processor.
    *
    * @throws SceneException if it has errors
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted
    */
  def prepare(settings: RenderSettings): Job =
    prepare(settings, Runtime.getRuntime.availableProcessors)

  /** Builds the scene: reads meshes, loads textures, builds the acceleration structure.
    *
    * @param threads at least 1
    * @throws SceneException if it has errors
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted; it
    *                                                    remains so
    */
  def prepare(settings: RenderSettings, threads: Int): Job =
    if threads < 1 then
      Problems.fail(Code.OptionValue, s"`threads` must be at least 1, found $threads")
    Job(this, settings, Problems.thrown(prepared(settings, threads, isRendered = true)))

  /** All errors and warnings, also of the scene's files; builds the scene and discards it.
    *
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted
    */
  def check(settings: RenderSettings): JList[Problem] = Problems.ofCore(checked(settings))

  private def checked(settings: RenderSettings): Vector[candela.diagnostics.Problem] =
    try
      val threads = Runtime.getRuntime.availableProcessors
      val ready = Problems.thrown(prepared(settings, threads, isRendered = false))
      ready.close()
      ready.warnings
    catch case e: SceneException => e.coreProblems

  /** Starts an edited copy of this scene.
    *
    * @throws SceneException if the scene could not be read
    */
  def edit(): SceneBuilder =
    val base = readable
    SceneBuilder(name, base.folder, Some(this))

  /** As `Scene(scene.pbrt, 3 shapes, 1 light)`. */
  override def toString: String =
    Shown("Scene", description.fold(Vector(name, "unreadable"))(Shown.contents(name, _))*)

  /** @throws SceneError if there is nothing */
  private def readable: SceneDescription = description.getOrElse(throw SceneException(readProblems))

  private def prepared(settings: RenderSettings, threads: Int, isRendered: Boolean): Prepared =
    val parsed = description.getOrElse(throw SceneError(readProblems))
    val coreSettings =
      Objects.requireNonNull(settings, "settings").core.copy(reading = reading.core)
    val control = reading.control.copy(threads = threads, isRendered = isRendered)
    // Lest an image be lost after all the time that it takes
    if coreSettings.output.denoise then Oidn.load(): Unit
    val ready = Render.build(parsed, coreSettings, control)
    try Problems.checkInterrupt()
    catch
      case e: InterruptedException =>
        ready.close()
        throw e
    ready

private[api] object Scenes:

  /** What `body` reads by the settings, whose time begins. */
  def read(name: String, settings: ReadSettings)(body: ReadSettings => SceneDescription): Scene =
    val reading = Objects.requireNonNull(settings, "settings").started
    def description = Problems.uninterrupted:
      val read = body(reading)
      Problems.checkInterrupt()
      read
    try of(name, description, reading)
    catch case e: SceneError => Scene(name, None, e.problems, reading)

  def of(name: String, description: SceneDescription, reading: ReadSettings): Scene =
    Scene(name, Some(description), description.errors ++ description.warnings, reading)

  /** A scene built in code. */
  def built(name: String, description: SceneDescription, reading: ReadSettings): Scene =
    Scene(name, Some(description), Vector.empty, reading, isBuilt = true)

package candela.job

import candela.base.JavaHeap
import candela.diagnostics.{Refusal, SceneError}
import candela.build.SceneBuilder
import candela.image.Image
import candela.render.{
  Cancellation, Deadline, RenderControl, Renderer, RenderFailure, Rendering, RenderPlan, ThreadPool
}
import candela.scenefile.{Excerpts, NamedText, SceneDescription}
import candela.settings.{BuildControl, ReadSettings, RenderSettings}

import java.nio.file.Path

/** What happens from a scene file to its images, in this order: [[read]] it, [[build]] a plan,
  * which its pilot completes, [[render]] the plan, [[develop]] the film, and write the image
  * ([[ImageFile]]). The command line, the library and Spark's executors call these stages, and do
  * between them what is theirs: messages, film files, live pages.
  */
object Render:

  /** The stages before rendering: reads, builds, and runs the pilot.
    *
    * @throws SceneError if there is no such scene, or it has errors
    */
  def prepare(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
    val (description, seconds) = timed(read(SceneName.existing(scene), settings.reading, control))
    build(description, settings, control).copy(readSeconds = seconds)

  /** Parses a file of any format, and those that it includes.
    *
    * @return the readable part of the scene; see [[SceneDescription.errors]]
    * @throws SceneError if nothing is readable
    */
  def read(file: Path, reading: ReadSettings, control: BuildControl): SceneDescription =
    try
      withinLimits():
        SceneFormat.of(file).read(file, control.limits.folder(file), reading, control.world)
    catch
      case e: SceneError =>
        val isConfined = control.limits.sandbox
        throw ForeignAdvice.problem(file, isConfined).fold(e)(SceneError(_))

  /** Parses a text.
    *
    * @param name of the text in messages; its suffix tells the format, unless the text is XML, and
    *             its folder is that of file names
    */
  def readText(
      name: Path,
      text: String,
      reading: ReadSettings,
      control: BuildControl
  ): SceneDescription =
    val format = SceneFormat.of(name, text)
    val source = Some(NamedText(name.toString, text))
    val scene = withinLimits(source):
      format.read(name, control.limits.folder(name), reading, control.world, Some(text))
    scene.copy(text = source, unfiled = Vector("the scene's text" -> format.digest(text)))

  /** Builds the objects that render the scene, each the simplest that does, and chooses the method.
    *
    * @throws SceneError if the scene has errors
    */
  def build(
      description: SceneDescription,
      settings: RenderSettings,
      control: BuildControl
  ): Prepared = withinLimits(description.text):
    val pool = ThreadPool(control.threads, worksAside = control.isRendered)
    try
      val limited = control.limited
      limited.cache.startScene()
      val ((built, plan), seconds) = timed:
        val built = SceneBuilder.buildViewed(description, settings, limited, pool)
        (built, if control.isRendered then piloted(built.plan, control) else built.plan)
      // Placeholders show nothing, and were told of
      val hasAll = built.warnings.forall(_.standIn.isEmpty)
      val allWarnings = description.warnings ++ built.warnings ++
        (if hasAll then EmptyImage.foreseen(plan, description.text) else None)
      Prepared(
        description,
        plan,
        allWarnings,
        buildSeconds = seconds,
        pool = pool,
        settings = settings,
        built = Some(built)
      )
    catch
      case e: Throwable =>
        pool.close()
        e match
          case e: SceneError => throw SceneError((e.problems ++ description.warnings).distinct)
          case _ => throw e

  private def piloted(plan: RenderPlan, control: BuildControl): RenderPlan =
    if plan.method.pilot.isEmpty then plan else control.stages.during("pilot")(plan.piloted)

  /** Takes samples until all are taken, the rule stops them, or the rendering is cancelled.
    *
    * @throws RenderFailure if a sample fails
    * @throws SceneError if the heap is full, with what takes it, or the time limit is reached
    */
  def render(prepared: Prepared, control: RenderControl): Rendering = withinLimits():
    val allowance = prepared.description.folder.allowance
    def rendered(control: RenderControl) =
      try Renderer.render(prepared.plan, control)
      catch
        case e: Throwable if isOfMemory(e) =>
          throw SceneError(prepared.plan.costs.problem(JavaHeap.limit, None))
    allowance.timeLeft.fold(rendered(control)): nanos =>
      val late = Cancellation()
      val limited = control.copy(cancellation = Cancellation(control.cancellation, late))
      val rendering = Deadline.during(nanos, grace = 0)(late.request(), ())(rendered(limited))
      if !rendering.isComplete then allowance.checkTime(None)
      rendering

  /** The image of the film: colours, layers, bands, and denoised colours if there is a denoiser. */
  def develop(prepared: Prepared, rendering: Rendering, denoising: Option[Denoising]): Image =
    val noisy = rendering.image(prepared.plan.development, prepared.pool)
    denoising.fold(noisy)(_(noisy))

  /** Makes a [[SceneError]] of what a scene must not do. */
  def withinLimits[A](text: Option[NamedText] = None)(body: => A): A =
    Refusal.asError(Excerpts.fill(_, Excerpts.sources(text)))(body)

  private def isOfMemory(e: Throwable): Boolean = e match
    case _: OutOfMemoryError => true
    case f: RenderFailure => f.getCause.isInstanceOf[OutOfMemoryError]
    case _ => false

  /** A result, and the seconds that it took. */
  private def timed[A](body: => A): (A, Double) =
    val start = System.nanoTime
    val result = body
    (result, (System.nanoTime - start) * 1e-9)

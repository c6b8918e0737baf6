package candela.api

import candela.diagnostics.Code
import candela.image.{Image, Oidn}
import candela.job.{
  Denoising, EmptyImage, ErrorRecorder, FilmHeaders, FilmKeeper, GoalRule, ImageFile, MissedGoal,
  Prepared, Render
}
import candela.render.{
  Cancellation as CoreCancellation, RenderControl as CoreControl, RenderFailure,
  RenderListener as CoreListener, Rendering, StoppingRule
}

import java.nio.file.Path
import java.util.function.Consumer
import java.util.{LinkedHashMap, List as JList, Map as JMap, Objects}

import scala.collection.mutable.ArrayBuffer

/** A prepared scene, which can be rendered any number of times, also concurrently. It holds the
  * scene's memory. Closing it ends its daemon threads.
  */
final class Job private[api] (scene: Scene, settings: RenderSettings, prepared: Prepared)
    extends AutoCloseable:
  private val plan = prepared.plan
  private val files = ImageFile(prepared.settings, scene.name, prepared)
  private val closing = CoreCancellation()

  /** Width of the image or crop window, in pixels. */
  def width: Int = plan.crop.width

  /** Height of the image or crop window, in pixels. */
  def height: Int = plan.crop.height

  /** Planned samples per pixel. */
  def samplesPerPixel: Int = plan.samplesPerPixel

  /** Warnings of reading and building. */
  def problems: JList[Problem] =
    val options = prepared.description.options.filter(_.name == "msereferenceout")
    val idle = options.flatMap(p => NamedOptions.idle("mse-reference-out", p.pos))
    Problems.ofCore(prepared.warnings ++ idle)

  /** Describes the scene and its rendering: integrator, lights, triangles, … */
  def features: JMap[String, String] =
    val entries = LinkedHashMap[String, String]()
    for (what, value) <- plan.features do entries.put(what, value): Unit
    java.util.Collections.unmodifiableMap(entries)

  /** Renders with one thread per processor. */
  def render(): RenderResult = render(RenderControl())

  /** @param threads at least 1 */
  def render(threads: Int): RenderResult = render(RenderControl().withThreads(threads))

  /** @param listener follows the rendering */
  def render(threads: Int, listener: RenderListener): RenderResult =
    render(RenderControl().withThreads(threads).withListener(listener))

  /** @param progressed called about ten times a second */
  def render(threads: Int, progressed: Consumer[Progress]): RenderResult =
    render(threads, RenderListeners.onProgress(progressed))

  /** Renders, and returns when the image is complete, a goal is reached, or the rendering is
    * cancelled, as closing the job does. The image does not depend on the threads.
    *
    * @throws SceneException if the film file belongs to another rendering, or can't be read; or
    *                        if the scene's time limit is reached
    * @throws RenderException if a sample fails
    * @throws java.util.concurrent.CancellationException if the calling thread is interrupted; it
    *                                                    remains so
    * @throws java.lang.IllegalStateException if the job is closed
    */
  def render(control: RenderControl): RenderResult =
    Objects.requireNonNull(control, "control")
    if isClosed then throw IllegalStateException("the job was closed")
    val problems = ArrayBuffer.empty[candela.diagnostics.Problem]
    Problems.thrown:
      control.film match
        case None => rendered(control, None, problems)
        case Some(file) =>
          val keeper = keeping(file, control, problems)
          try rendered(control, Some(keeper), problems)
          finally keeper.close()

  /** As `Job(scene.pbrt, 640x360, 16 samples per pixel)`. */
  override def toString: String =
    val state = if isClosed then "closed" else ""
    Shown("Job", scene.name, s"${width}x$height", Shown.perPixel(samplesPerPixel), state)

  /** Ends its threads. What it renders ends as if it were cancelled: each rendering returns its
    * image so far within a second.
    */
  def close(): Unit =
    closing.request()
    prepared.close()

  private def isClosed = closing.isRequested

  private def keeping(
      file: Path,
      control: RenderControl,
      problems: ArrayBuffer[candela.diagnostics.Problem]
  ): FilmKeeper =
    val path =
      Problems.onDisk(file, Code.Unwritable, "name a file of the default one").toAbsolutePath
    val header = FilmHeaders.of(prepared.settings, scene.name, prepared, path)
    val filmOptions =
      FilmKeeper.How(control.every, problems += _, savesError = true)
    FilmKeeper.of(path, header, filmOptions)(FilmKeeper.locked(path))

  private def rendered(
      control: RenderControl,
      keeper: Option[FilmKeeper],
      problems: ArrayBuffer[candela.diagnostics.Problem]
  ): RenderResult =
    val target = settings.core.goal
    val recorder =
      Option.when(control.estimates || target.isGiven)(ErrorRecorder(plan.development, None))
    val earlier = keeper.flatMap(k => k.savedError(k.samplesDone))
    val goal = recorder.filter(_ => target.isGiven)
      .map(GoalRule(target, plan.samplesPerPixel, _, earlier = earlier, isLimited = plan.isLimited))
    val estimating = recorder.filter(_ => goal.isEmpty)
    val followed = Followed(control.listener, r => image(r, r.image(plan.development), None))
    val checkpoints = keeper.map(_.checkpointer(n => recorder.flatMap(_.relativeMse(n))))
    val coreControl = CoreControl(
      control.threads,
      CoreCancellation(control.cancellation.core, closing),
      CoreListener.all(estimating.toVector :+ followed),
      checkpointer = checkpoints,
      rule = goal.getOrElse(StoppingRule.Never)
    )
    val rendering =
      try Render.render(prepared, coreControl)
      catch
        case e: RenderFailure =>
          throw RenderException(e.x, e.y, e.sample, Option(e.getCause).getOrElse(e))
    val errorRecorder = recorder.filter(_ => rendering.samplesDone >= GoalRule.MinSamples)
    // Of a film that had all samples, no others tell the error
    def savedError =
      for
        _ <- errorRecorder
        error <- keeper.flatMap(_.savedError(rendering.samplesDone))
      yield Math.sqrt(error.estimate)
    val denoising =
      Option.when(settings.core.output.denoise)(Denoising(Oidn.load(), control.threads))
    val developed = Render.develop(prepared, rendering, denoising)
    RenderResult(
      rendering,
      image(rendering, developed, denoising.map(_.describe)),
      errorRecorder.flatMap(_.errorAt(rendering.samplesDone)).orElse(savedError),
      recorder.flatMap(_.squares(rendering.samplesDone)).map(errors(_, developed)),
      problems.toVector ++ goal.flatMap(MissedGoal.problem(_, rendering)) ++
        EmptyImage.problem(prepared, rendering, developed)
    )

  private def image(rendering: Rendering, image: Image, denoiser: Option[String]): RenderedImage =
    RenderedImages.of(image, files, rendering, denoiser)

  private def errors(squares: Array[Float], like: Image): RenderedImage =
    val data = squares.map(s => Math.sqrt(s.toDouble).toFloat)
    RenderedImages.plain(
      Image(like.width, like.height, Image.RgbNames, data, colorSpace = like.colorSpace)
    )

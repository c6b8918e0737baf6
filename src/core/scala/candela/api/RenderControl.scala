package candela.api

import candela.diagnostics.Code
import candela.render.storage.FilmFile
import java.nio.file.Path
import java.time.Duration
import java.util.Objects

/** Controls a rendering without changing its image. Immutable: each method returns a new value. */
final class RenderControl private (
    private[api] val threads: Int,
    private[api] val listener: RenderListener,
    private[api] val cancellation: Cancellation,
    private[api] val estimates: Boolean,
    private[api] val film: Option[Path],
    private[api] val every: Option[Double]
):
  private def copy(
      threads: Int = threads,
      listener: RenderListener = listener,
      cancellation: Cancellation = cancellation,
      estimates: Boolean = estimates,
      film: Option[Path] = film,
      every: Option[Double] = every
  ): RenderControl = new RenderControl(threads, listener, cancellation, estimates, film, every)

  /** @param count at least 1 (default: one per processor) */
  def withThreads(count: Int): RenderControl =
    if count < 1 then Problems.fail(Code.OptionValue, s"`threads` must be at least 1, found $count")
    copy(threads = count)

  def withListener(listener: RenderListener): RenderControl =
    copy(listener = Objects.requireNonNull(listener, "listener"))

  def withCancellation(cancellation: Cancellation): RenderControl =
    copy(cancellation = Objects.requireNonNull(cancellation, "cancellation"))

  /** Estimates the error during rendering, which costs a few percent of the time. */
  def withErrorEstimates: RenderControl = copy(estimates = true)

  /** Saves the rendering in a film file (`.film`), which `candela resume` can continue, too. An
    * existing film of this rendering is continued; the image is bit-identical to that of an
    * uninterrupted rendering.
    *
    * @throws SceneException if the name doesn't end with `.film`
    */
  def withFilm(file: Path): RenderControl =
    if !FilmFile.isName(Objects.requireNonNull(file, "file").toString) then
      val message = s"`file` must be a name that ends with .${FilmFile.Suffix}, found `$file`"
      Problems.fail(Code.OptionValue, message)
    copy(film = Some(file))

  /** Sets how often the file of [[withFilm]] is written, which is also written at the end; without
    * it, nothing is.
    */
  def withFilmInterval(time: Duration): RenderControl =
    copy(every = Some(Times.positive("the interval", time)))

  /** As `RenderControl(4 threads, image.film)`. */
  override def toString: String =
    val estimated = if estimates then "error estimates" else ""
    val file = film.fold("")(_.toString)
    Shown("RenderControl", Shown.count(threads, "thread"), estimated, file)

object RenderControl:
  /** One thread per processor, no listener. */
  def apply(): RenderControl =
    val processors = Runtime.getRuntime.availableProcessors
    new RenderControl(processors, RenderListeners.Silent, Cancellation(), false, None, None)

  /** One thread per processor, no listener, for Java and Kotlin. */
  def create(): RenderControl = apply()

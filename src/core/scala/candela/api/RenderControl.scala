package candela.api

import candela.base.Code

import java.nio.file.Path
import java.time.Duration

/** How a job is rendered; the image is the same. Immutable: each method returns another value. */
final class RenderControl private (
    private[api] val threads: Int,
    private[api] val listener: RenderListener,
    private[api] val cancellation: Cancellation,
    private[api] val estimates: Boolean,
    private[api] val film: Option[Path],
    private[api] val every: Option[Duration]
):
  private def copy(
      threads: Int = threads,
      listener: RenderListener = listener,
      cancellation: Cancellation = cancellation,
      estimates: Boolean = estimates,
      film: Option[Path] = film,
      every: Option[Duration] = every
  ): RenderControl = new RenderControl(threads, listener, cancellation, estimates, film, every)

  /** @param count at least 1; without it, as many as there are processors */
  def withThreads(count: Int): RenderControl =
    if count < 1 then Problems.fail(Code.OptionValue, s"`threads` must be at least 1, found $count")
    copy(threads = count)

  def withListener(listener: RenderListener): RenderControl = copy(listener = listener)

  def withCancellation(cancellation: Cancellation): RenderControl =
    copy(cancellation = cancellation)

  /** Estimates the error of the image while it is rendered, which costs a few percent of the time.
    */
  def withErrorEstimates: RenderControl = copy(estimates = true)

  /** Keeps the rendering in a film file (`.film`), which `candela resume`, too, continues. If there
    * is one of this very rendering, it goes on; the image is the same as if it had not been
    * interrupted, bit for bit.
    */
  def withFilm(file: Path): RenderControl = copy(film = Some(file))

  /** How often the film file is written, if not as often as is worth it; and at the end. */
  def withFilmInterval(time: Duration): RenderControl = copy(every = Some(time))

object RenderControl:
  /** By all processors, unobserved. */
  def apply(): RenderControl =
    val processors = Runtime.getRuntime.availableProcessors
    new RenderControl(processors, RenderListeners.Silent, Cancellation(), false, None, None)

  /** By all processors, unobserved, for Java and Kotlin. */
  def create(): RenderControl = apply()

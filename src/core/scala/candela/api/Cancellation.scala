package candela.api

/** Ends renderings early, from any thread. */
final class Cancellation private (private[api] val core: candela.render.Cancellation):

  /** Cancels all renderings with this object. Each returns its image so far within a second. */
  def cancel(): Unit = core.request()
  def isCancelled: Boolean = core.isRequested
  override def toString: String = Shown("Cancellation", if isCancelled then "cancelled" else "")

object Cancellation:
  def apply(): Cancellation = new Cancellation(candela.render.Cancellation())

  /** For Java and Kotlin. */
  def create(): Cancellation = apply()

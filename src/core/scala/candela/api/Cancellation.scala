package candela.api

/** Ends renderings early, from any thread. */
final class Cancellation private (private[api] val of: candela.render.Cancellation):

  /** Asks the renderings that have it to end. Each does so within a second, and returns what it has
    * of its image.
    */
  def cancel(): Unit = of.request()
  def isCancelled: Boolean = of.isRequested

object Cancellation:
  def apply(): Cancellation = new Cancellation(candela.render.Cancellation())

  /** For Java and Kotlin. */
  def create(): Cancellation = apply()

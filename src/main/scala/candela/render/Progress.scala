package candela.render

/** How far a rendering is.
  *
  * @param done    camera samples taken, of `total`
  * @param seconds since it began
  */
final case class Progress(done: Long, total: Long, seconds: Double)

/** How a rendering is asked, from any thread, to stop soon and hand over what there is. */
final class Cancellation:
  @volatile private var requested = false
  def request(): Unit = requested = true
  def isRequested: Boolean = requested

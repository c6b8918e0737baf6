package candela.watch

import java.util.concurrent.ConcurrentHashMap

/** The pages that are open, as far as their requests tell. */
final class Viewers:
  import Viewers.*

  private val viewers = ConcurrentHashMap[String, Viewer]()

  /** Notes a request of the page `name`.
    *
    * @param hasAll whether it shows the last image
    */
  def saw(name: String, hasAll: Boolean): Unit =
    if viewers.containsKey(name) || count < MaxViewers then
      val _ = viewers.put(name, Viewer(System.nanoTime, hasAll))

  def count: Int =
    val _ = viewers.values.removeIf(viewer => (System.nanoTime - viewer.nanos) * 1e-9 > MaxSeconds)
    viewers.size

  /** Whether every page that is still there shows the last image. */
  def haveAll: Boolean = count == 0 || viewers.values.stream.allMatch(_.hasAll)

object Viewers:
  /** @param nanos of its last request */
  private final case class Viewer(nanos: Long, hasAll: Boolean)

  /** Between two requests; a page asks at least every five seconds. */
  private val MaxSeconds = 6.0
  private val MaxViewers = 100

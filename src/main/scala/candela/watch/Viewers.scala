package candela.watch

import java.util.concurrent.ConcurrentHashMap

/** The pages that are open, as far as their requests tell. */
final class Viewers:
  import Viewers.*

  private val all = ConcurrentHashMap[String, Viewer]()

  /** Notes a request of the page `name`.
    *
    * @param hasAll whether it shows the last image
    */
  def saw(name: String, hasAll: Boolean): Unit =
    val _ = all.values.removeIf(_.age > Forgotten)
    if all.containsKey(name) || all.size < MaxViewers then
      val _ = all.put(name, Viewer(System.nanoTime, hasAll))

  def count: Int =
    var n = 0
    all.forEach((_, viewer) => if viewer.age < Present then n += 1)
    n

  /** Whether every page that is still there shows the last image. */
  def haveAll: Boolean = all.values.stream.allMatch(v => v.hasAll || v.age >= Present)

object Viewers:
  private final case class Viewer(nanos: Long, hasAll: Boolean):
    /** Seconds since its last request. */
    def age: Double = (System.nanoTime - nanos) * 1e-9

  /** A page asks at least every five seconds. */
  private val Present = 6.0
  private val Forgotten = 60.0
  private val MaxViewers = 100

package candela.build.recipe

import candela.render.CostKind

/** Tells how long the parts of a scene take to build. What is built within another part counts for
  * itself alone. The thread that made it is observed; others work for it.
  */
final class BuildClock:
  private val owner = Thread.currentThread
  private val nanos = new Array[Long](CostKind.values.length)
  private var kind = -1
  private var start = 0L

  /** Runs `body`, whose time is of `part`. */
  def during[A](part: CostKind)(body: => A): A =
    if Thread.currentThread ne owner then body
    else
      val outer = kind
      turn(part.ordinal)
      try body
      finally turn(outer)

  /** Of the part, so far. */
  def seconds(part: CostKind): Double = nanos(part.ordinal) * 1e-9

  private def turn(to: Int): Unit =
    val time = System.nanoTime
    if kind >= 0 then nanos(kind) += time - start
    kind = to
    start = time

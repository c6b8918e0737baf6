package candela.accel.tracing

import java.util.concurrent.atomic.AtomicBoolean

/** Decides when a kernel that is slow until the JVM has compiled it starts to pay: as soon as it is
  * measured to be faster than the scalar kernel on the same rays.
  *
  * Uncompiled SIMD code is about a hundred times slower. So one thread at a time runs a trial, a
  * [[WarmUp.Batch]] of rays by both kernels, while the others continue with scalar code. The first
  * [[WarmUp.Enough]] trials make the JVM compile the kernel; later ones check, for no more than a
  * fraction of the time, whether it has. Compiled code remains so for all scenes.
  */
private[tracing] final class WarmUp:
  import WarmUp.*

  /** Whether the kernel has been faster. Never reverts. */
  @volatile var isOver = false

  private val isTrying = AtomicBoolean()

  // State of the thread that runs trials
  private var tries = 0
  private var scalarNanos, fastNanos = 0L

  /** Traversals until the next trial; threads write it unsynchronised, as a few more or less do not
    * matter.
    */
  private var pause = 0

  /** Whether it is the caller's turn to run a trial; it must then call [[record]]. */
  def claimsTrial(): Boolean =
    if pause > 0 then
      pause -= 1
      false
    else isTrying.compareAndSet(false, true)

  /** Records the time that both kernels took for one ray. */
  def record(scalar: Long, fast: Long): Unit =
    scalarNanos += scalar
    fastNanos += fast
    tries += 1
    if tries % Batch == 0 then
      if fastNanos < scalarNanos then isOver = true
      else if tries >= Enough then
        pause = (Batch * Rest * Math.min(fastNanos / Math.max(1L, scalarNanos), Most)).toInt
      scalarNanos = 0L
      fastNanos = 0L
    isTrying.set(false)

private[tracing] object WarmUp:
  final val Batch = 64

  /** Traversals after which the JVM compiles a method with a loop (its Tier4 thresholds). */
  final val Enough = 5120

  /** Time spent in scalar traversal between trials, relative to a trial. */
  private final val Rest = 8

  /** Cap on a measured slowdown, so that one interruption does not delay the decision for ever. */
  private final val Most = 1000L

  /** One for each query of the one kernel that needs to warm up. */
  val closest, occluded = WarmUp()

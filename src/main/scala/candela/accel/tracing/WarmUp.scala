package candela.accel.tracing

import java.util.concurrent.atomic.AtomicBoolean

/** When walks by a kernel that is slow until the JVM has compiled it begin to pay: as soon as it
  * has been seen to be faster than the scalar one, on the same rays.
  *
  * Code with vectors takes a hundred times as long before. So one thread at a time tries it, a
  * [[WarmUp.Batch]] of rays by both kernels, while the others walk on with scalars. The first
  * [[WarmUp.Enough]] tries make the JVM compile it; later ones look whether it has, at no more than
  * a fraction of the time. What was compiled stays so for all scenes.
  */
private[tracing] final class WarmUp:
  import WarmUp.*

  /** Has the kernel been faster? Never goes back. */
  @volatile var isOver = false

  private val isTrying = AtomicBoolean()

  // Of the thread that is trying
  private var tries = 0
  private var scalarNanos, fastNanos = 0L

  /** Walks until the next try: written by all threads without order, as many or few more do. */
  private var pause = 0

  /** Is it the caller's turn? Then it has to [[tell]]. */
  def turn(): Boolean =
    if pause > 0 then
      pause -= 1
      false
    else isTrying.compareAndSet(false, true)

  /** How long both kernels took for one ray. */
  def tell(scalar: Long, fast: Long): Unit =
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

  /** Walks after which the JVM wants to compile a method with a loop (its Tier4 thresholds). */
  final val Enough = 5120

  /** How much longer walks go on with scalars than a try takes. */
  private final val Rest = 8

  /** Times slower that counts as such: one interruption is no reason to wait for ever. */
  private final val Most = 1000L

  /** One for each walk of the one kernel that has to be warm. */
  val closest, occluded = WarmUp()

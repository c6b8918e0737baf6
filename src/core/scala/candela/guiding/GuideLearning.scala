package candela.guiding

import java.util.concurrent.CountDownLatch
import java.util.concurrent.TimeUnit.MILLISECONDS
import java.util.concurrent.atomic.AtomicInteger

/** The end of a pass: all workers that come to it fit regions, and go on when the field is whole.
  */
private[guiding] final class GuideLearning(prepare: => GuideGrowth):
  private val started = System.nanoTime

  /** Seconds since the pass ended. */
  def seconds: Double = (System.nanoTime - started) * 1e-9

  /** Made by the first worker; the others wait. */
  lazy val growth: GuideGrowth = prepare
  private val next = AtomicInteger()
  private lazy val remaining = CountDownLatch(growth.regions)

  /** Fits regions until all are fitted.
    *
    * @param moves called after each region: fitting may take longer than a stopped rendering waits
    *   for workers that do nothing
    * @param isLeft whether to give up
    * @return false if it was given up
    */
  def help(moves: () => Unit, isLeft: () => Boolean): Boolean =
    val fit = growth.newFit()
    var isMore = true
    while isMore && !isLeft() do
      val region = next.getAndIncrement()
      isMore = region < growth.regions
      if isMore then
        try growth.grow(region, fit)
        finally remaining.countDown()
        moves()
    while !remaining.await(GuideLearning.Pause, MILLISECONDS) && !isLeft() do ()
    remaining.getCount == 0

private object GuideLearning:
  /** Between two looks at whether to give up. */
  val Pause = 20L

package candela.guiding

import java.util.concurrent.CountDownLatch
import java.util.concurrent.atomic.AtomicInteger

/** The end of a pass: all workers that come to it fit regions, and go on when the field is whole.
  */
private[guiding] final class GuideLearning(prepare: => GuideGrowth):
  /** Made by the first worker; the others wait. */
  lazy val growth: GuideGrowth = prepare
  private val next = AtomicInteger()
  private lazy val left = CountDownLatch(growth.regions)

  /** Fits regions until all are fitted.
    *
    * @param moves called after each region: fitting may take longer than a stopped rendering waits
    *   for workers that do nothing
    */
  def help(moves: () => Unit): Unit =
    val fit = growth.newFit()
    var region = next.getAndIncrement()
    while region < growth.regions do
      try growth.grow(region, fit)
      finally left.countDown()
      moves()
      region = next.getAndIncrement()
    left.await()

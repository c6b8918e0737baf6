package candela.render

import candela.color.Rgb

import java.util.concurrent.CountDownLatch
import java.util.concurrent.atomic.AtomicBoolean

import org.scalatest.funsuite.AnyFunSuite

/** Renderings one of whose samples does not end. */
class EndlessSamplesSuite extends AnyFunSuite:

  /** Seconds until a rendering whose first samples wait for ever ends, and its result. */
  private def rendered(
      threads: Int,
      listener: RenderListener = RenderListener.Silent,
      checkpointer: Option[Checkpointer] = None,
      stopAfter: Double = Double.PositiveInfinity
  ): (Double, Rendering) =
    val latch = CountDownLatch(1)
    val begun = AtomicBoolean()
    val plan = TinyPlan(spp = 4): (where, _) =>
      if where.x == 3 && where.y == 3 && !begun.getAndSet(true) then latch.await()
      Rgb.White
    val cancellation = Cancellation()
    val started = System.nanoTime
    def seconds = (System.nanoTime - started) * 1e-9
    val stop =
      RenderListener.onProgress(_ => if seconds > stopAfter then cancellation.request())
    try
      val result = Renderer.render(
        plan,
        threads,
        cancellation,
        RenderListener.all(Vector(stop, listener)),
        checkpointer = checkpointer
      )
      (seconds, result)
    finally latch.countDown()

  /** A second, and more for a busy machine. */
  private val Soon = 10.0

  for threads <- Vector(1, 3) do
    test(s"a cancelled rendering of $threads threads does not wait for a sample without end"):
      val (seconds, rendering) = rendered(threads, stopAfter = 0.2)
      assert(seconds < 0.2 + Soon)
      assert(rendering.samplesDone == 0 && !rendering.isComplete)

  test("nor does one that ends at a time"):
    val timed = new RenderListener:
      var isEnded = false
      override def looks: Looks = Looks.Doublings
      override def isEnough: Boolean = isEnded
      override def isOver(seconds: Double, still: Double): Boolean =
        isEnded = seconds > 0.2 && still > 0.1
        isEnded
    assert(rendered(2, timed)._1 < 0.2 + Soon)

  test("nor one that keeps copies, the last of which is then not replaced"):
    final class Counting(due: Boolean) extends Checkpointer:
      var saved = 0
      var lost = 0
      def restore(state: RenderState): Unit = ()
      def isDue: Boolean = due
      def save(state: RenderState): Unit = saved += 1
      def lose(): Unit = lost += 1
      def finish(): Unit = ()
    for due <- Vector(false, true) do
      val keeper = Counting(due)
      assert(rendered(1, checkpointer = Some(keeper), stopAfter = 0.2)._1 < 0.2 + Soon)
      assert(keeper.saved == 0 && keeper.lost == 1)

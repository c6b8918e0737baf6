package candela.render

import candela.color.Rgb

import java.util.concurrent.atomic.AtomicBoolean
import java.util.concurrent.{CountDownLatch, TimeUnit}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Renderings one of whose samples does not end. */
class EndlessSamplesSuite extends AnyFunSuite:

  /** A rendering whose first sample of a pixel lasts longer than the rendering. */
  private final class Endless:
    private val hasEnded = CountDownLatch(1)
    private val hasBegun, wasAwaited = AtomicBoolean()

    /** Whether the sample has begun. */
    def isBegun: Boolean = hasBegun.get

    private val plan = TinyPlan(spp = 4): (where, _) =>
      if where.x == 3 && where.y == 3 && !hasBegun.getAndSet(true) then
        // The minute ends this test alone, if the rendering waits for the sample
        if !hasEnded.await(1, TimeUnit.MINUTES) then wasAwaited.set(true)
      Rgb.White

    /** Its result; it must end without the sample.
      *
      * @param isCancelled whether it is, once the sample has begun
      */
    def rendered(
        threads: Int,
        rule: StoppingRule = StoppingRule.Never,
        checkpointer: Option[Checkpointer] = None,
        isCancelled: Boolean = true
    ): Rendering =
      val cancellation = Cancellation()
      val stop =
        RenderListener.onProgress(_ => if isCancelled && isBegun then cancellation.request())
      try
        val result = Renderer.render(
          plan,
          RenderControl(threads,
            cancellation,
            stop, rule = rule,
            checkpointer = checkpointer)
        )
        assert(!wasAwaited.get)
        result
      finally hasEnded.countDown()

  for threads <- Vector(1, 3) do
    test(s"a cancelled rendering of $threads threads does not wait for a sample without end"):
      val rendering = Endless().rendered(threads)
      assert(rendering.samplesDone == 0 && !rendering.isComplete)

  test("nor does one that ends at a time"):
    val endless = Endless()
    val timed = new StoppingRule:
      var isEnded = false
      override def frequency: Looks = Looks.Doublings
      override def stopsAfterPass: Boolean = isEnded
      override def stopsNow(seconds: Double, idleSeconds: Double): Boolean =
        isEnded = endless.isBegun && idleSeconds > 0.1
        isEnded
    assert(!endless.rendered(2, timed, isCancelled = false).isComplete)

  test("nor one that keeps copies, the last of which is then not replaced", Slow):
    for due <- Vector(false, true) do
      val endless = Endless()
      object Keeper extends Checkpointer:
        var saved = 0
        var lost = 0
        def restore(state: RenderState): Unit = ()
        def isDue: Boolean = due && endless.isBegun
        def save(state: RenderState): Unit = saved += 1
        def discard(): Unit = lost += 1
        def finish(): Unit = ()
      val _ = endless.rendered(1, checkpointer = Some(Keeper))
      assert(Keeper.saved == 0 && Keeper.lost == 1)

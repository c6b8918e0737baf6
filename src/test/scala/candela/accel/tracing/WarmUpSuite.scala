package candela.accel.tracing

import org.scalatest.funsuite.AnyFunSuite

class WarmUpSuite extends AnyFunSuite:
  import WarmUp.{Batch, Enough}

  private def tell(warmUp: WarmUp, times: Int, fast: Long): Unit =
    for _ <- 0 until times do
      while !warmUp.claimsTrial() do ()
      warmUp.record(100L, fast)

  test("a kernel is taken after the first batch in which it was faster"):
    val warmUp = WarmUp()
    tell(warmUp, Enough, 101L)
    assert(!warmUp.isOver)
    tell(warmUp, Batch - 1, 99L)
    assert(!warmUp.isOver)
    tell(warmUp, 1, 99L)
    assert(warmUp.isOver)

  test("one thread at a time tries"):
    val warmUp = WarmUp()
    assert(warmUp.claimsTrial() && !warmUp.claimsTrial())
    warmUp.record(1L, 1L)
    assert(warmUp.claimsTrial())

  test("nobody waits until the JVM has a reason to compile"):
    val warmUp = WarmUp()
    for _ <- 0 until Enough do
      assert(warmUp.claimsTrial())
      warmUp.record(100L, 5000L)
    assert(!warmUp.claimsTrial())

  test("later tries take a small part of the time, however slow they are"):
    for slowness <- Seq(2L, 50L, 900L) do
      val warmUp = WarmUp()
      tell(warmUp, Enough, 100 * slowness)
      var (scalar, fast) = (0L, 0L)
      for _ <- 0 until 2_000_000 do
        if warmUp.claimsTrial() then
          warmUp.record(100L, 100 * slowness)
          fast += 100 * slowness
        else scalar += 100L
      val part = fast.toDouble / (fast + scalar)
      assert(part > 0.05 && part < 0.13, s"$slowness times slower: $part"): Unit
      assert(!warmUp.isOver): Unit

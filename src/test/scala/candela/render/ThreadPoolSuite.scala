package candela.render

import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import java.util.concurrent.CountDownLatch
import java.util.concurrent.atomic.{AtomicInteger, AtomicIntegerArray}

class ThreadPoolSuite extends AnyFunSuite:

  private val pools: Seq[Parallel] =
    Seq(Parallel.Alone, ThreadPool(1), ThreadPool(2), ThreadPool(5))

  test("each piece of work is done once, before the call returns"):
    for pool <- pools; count <- Seq(0, 1, 2, 3, 1000) do
      val done = AtomicIntegerArray(count)
      pool.forEach(count)(i => done.incrementAndGet(i): Unit)
      assert((0 until count).forall(i => done.get(i) == 1), s"$count with ${pool.threads}")

  test("ranges make up the whole"):
    for pool <- pools; count <- Seq(0, 1, 5000, 100_003) do
      val done = AtomicIntegerArray(count)
      pool.ranges(count)((from, until) =>
        (from until until).foreach(i => done.addAndGet(i, 1): Unit)
      )
      assert((0 until count).forall(i => done.get(i) == 1), s"$count with ${pool.threads}")

  test("what a piece of work throws is thrown to the caller"):
    for pool <- pools do
      val error = intercept[IllegalStateException]:
        pool.forEach(100)(i => if i == 57 then throw IllegalStateException("57"))
      assert(error.getMessage == "57")

  test("the same threads help again"):
    val pool = ThreadPool(3)
    val seen = java.util.concurrent.ConcurrentHashMap.newKeySet[Thread]()
    for _ <- 1 to 50 do
      pool.forEach(3): _ =>
        seen.add(Thread.currentThread): Unit
        Thread.sleep(1)
    assert(seen.contains(Thread.currentThread) && seen.size <= 3)

  test("nobody waits for a helper that is busy with other work"):
    val pool = ThreadPool(2)
    val (isHelping, mayEnd) = (CountDownLatch(1), CountDownLatch(1))
    val other = Thread(() =>
      pool.forEach(2): _ =>
        if Thread.currentThread.getName.startsWith("candela-helper") then isHelping.countDown()
        mayEnd.await()
    )
    other.start()
    isHelping.await()
    val done = AtomicInteger()
    pool.forEach(100)(_ => done.incrementAndGet(): Unit)
    assert(done.get == 100)
    mayEnd.countDown()
    other.join()

  test("several threads work at the same time"):
    val both = CountDownLatch(2)
    ThreadPool(2).forEach(2): _ =>
      both.countDown()
      if !both.await(10, java.util.concurrent.TimeUnit.SECONDS) then fail("one waits for the other")

  test("a task aside runs while the caller goes on, on a thread that does not keep the JVM alive"):
    val latch = CountDownLatch(1)
    val thread = java.util.concurrent.CompletableFuture[Thread]()
    ThreadPool(1).aside("some-task"):
      latch.await()
      thread.complete(Thread.currentThread): Unit
    latch.countDown()
    val found = thread.get(10, java.util.concurrent.TimeUnit.SECONDS)
    assert(found.getName == "candela-some-task" && found.isDaemon)

  test("the threads of a pool that is closed end, and what it is asked then is done all the same"):
    import java.util.concurrent.ConcurrentHashMap
    val seen = ConcurrentHashMap.newKeySet[Thread]()
    val pool = ThreadPool(3)
    def work(): Int =
      val done = AtomicInteger()
      pool.forEach(100): _ =>
        seen.add(Thread.currentThread): Unit
        done.incrementAndGet(): Unit
      done.get
    assert(work() == 100)
    val begun = CountDownLatch(1)
    pool.aside("endless"):
      seen.add(Thread.currentThread): Unit
      begun.countDown()
      Thread.sleep(Long.MaxValue)
    begun.await()
    pool.close()
    seen.remove(Thread.currentThread): Unit
    for thread <- seen.toArray(Array.empty[Thread]) do
      thread.join(10_000)
      assert(!thread.isAlive, thread.getName)
    assert(work() == 100)

  test("nothing runs aside where nothing is rendered"):
    val hasRun = CountDownLatch(1)
    ThreadPool(2, worksAside = false).aside("some-task")(hasRun.countDown())
    assert(!hasRun.await(200, java.util.concurrent.TimeUnit.MILLISECONDS))

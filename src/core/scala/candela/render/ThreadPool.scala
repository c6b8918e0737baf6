package candela.render

import candela.concurrency.Parallel
import java.util.concurrent.{CountDownLatch, LinkedBlockingQueue, ThreadPoolExecutor}
import java.util.concurrent.TimeUnit.SECONDS
import java.util.concurrent.atomic.{AtomicInteger, AtomicReference}

/** A thread pool that executes divisible tasks, the calling thread included.
  *
  * Callers never wait for a helper that has not begun: starting or waking one takes milliseconds
  * where the JIT compiler keeps all processors busy, and building a scene divides hundreds of small
  * tasks. Helpers that find nothing to do for some seconds end. Whose pool it is closes it: all of
  * its threads then end.
  *
  * @param worksAside false where nothing is rendered, for which work aside prepares
  */
final class ThreadPool(val threads: Int, val worksAside: Boolean = true)
    extends Parallel, AutoCloseable:
  require(threads >= 1, s"`threads` must be at least 1, found $threads")

  private var isClosed = false
  private var asides = Vector.empty[Thread]
  private var working = Option.empty[ThreadPoolExecutor]

  private def helpers: Option[ThreadPoolExecutor] = synchronized:
    if isClosed then None
    else
      if working.isEmpty then working = Some(newExecutor())
      working

  private def newExecutor(): ThreadPoolExecutor =
    val started = AtomicInteger()
    val executor = ThreadPoolExecutor(
      threads - 1,
      threads - 1,
      ThreadPool.IdleSeconds,
      SECONDS,
      LinkedBlockingQueue[Runnable](),
      task => ThreadPool.thread(s"helper-${started.incrementAndGet()}", task),
      ThreadPoolExecutor.DiscardPolicy() // of what is asked once it is closed: the caller does it
    )
    executor.allowCoreThreadTimeOut(true)
    executor

  def forEach(count: Int)(task: Int => Unit): Unit =
    if threads == 1 || count <= 1 then Parallel.Alone.forEach(count)(task)
    else
      val nextIndex = AtomicInteger()
      val remaining = CountDownLatch(count)
      val failure = AtomicReference[Throwable | Null](null)
      val work: Runnable = () =>
        var i = nextIndex.getAndIncrement()
        while i < count do
          try if failure.get == null then task(i)
          catch
            case e: Throwable =>
              val _ = failure.compareAndSet(null, e)
          finally remaining.countDown()
          i = nextIndex.getAndIncrement()
      var helpersLeft = Math.min(threads, count) - 1
      for pool <- helpers do
        while helpersLeft > 0 do
          pool.execute(work)
          helpersLeft -= 1
      work.run()
      remaining.await()
      val thrown = failure.get
      if thrown != null then throw thrown

  def aside(name: String)(task: => Unit): Unit =
    val work: Runnable = () =>
      try task
      catch case _: InterruptedException => ()
    val thread = ThreadPool.thread(name, work)
    synchronized:
      if worksAside && !isClosed then
        asides :+= thread
        thread.start()

  /** Ends its threads, soon; what is asked of it later, its callers do alone. */
  def close(): Unit = synchronized:
    isClosed = true
    working.foreach(_.shutdown())
    asides.foreach(_.interrupt())

object ThreadPool:
  /** For textures within each other, in bytes; memory is taken only as it is used. */
  private val StackSize = 16L << 20

  /** An idle helper ends after this time. */
  private inline val IdleSeconds = 5L

  /** One that does not keep the JVM alive. */
  private[render] def thread(name: String, work: Runnable): Thread =
    val daemon = Thread(null, work, s"candela-$name", StackSize)
    daemon.setDaemon(true)
    daemon

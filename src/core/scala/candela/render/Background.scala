package candela.render

import java.util.concurrent.locks.LockSupport
import java.util.concurrent.{ExecutorService, LinkedBlockingQueue, ThreadPoolExecutor, TimeUnit}

/** Threads beside a rendering, for observers. All are daemons: none keeps the program running. */
object Background:

  /** A task repeated in a thread of its own. */
  abstract class Repeated extends AutoCloseable:
    /** Stops repeating; waits for the task, if it is running. */
    def close(): Unit

  /** Runs `task` now and `millis` milliseconds after its end, until closed. Failures end it. */
  def repeat(name: String, millis: Long)(task: () => Unit): Repeated = new Repeated:
    @volatile private var isClosed = false
    private val loop: Runnable = () =>
      while !isClosed do
        task()
        if !isClosed then LockSupport.parkNanos(millis * 1_000_000)
    private val thread = daemon(name)(loop)
    thread.start()

    def close(): Unit =
      isClosed = true
      LockSupport.unpark(thread)
      thread.join()

  /** At most `most` threads, started on demand, which end when there is nothing to do. */
  def pool(name: String, most: Int): ExecutorService =
    val queue = LinkedBlockingQueue[Runnable]()
    val threads = ThreadPoolExecutor(most, most, 10, TimeUnit.SECONDS, queue, daemon(name)(_))
    threads.allowCoreThreadTimeOut(true)
    threads

  private def daemon(name: String)(work: Runnable): Thread =
    val thread = Thread(work, s"candela-$name")
    thread.setDaemon(true)
    thread

package candela.render

import candela.base.Parallel

import java.util.concurrent.atomic.{AtomicInteger, AtomicReference}

/** A thread pool that executes divisible tasks, the calling thread included.
  *
  * Threads live for one call: starting one takes some 50 µs, little beside tasks worth dividing,
  * and there is nothing to shut down.
  *
  * @param worksAside false where nothing is rendered, for which work aside prepares
  */
final class ThreadPool(val threads: Int, val worksAside: Boolean = true) extends Parallel:
  require(threads >= 1, s"`threads` must be at least 1, found $threads")

  def each(count: Int)(task: Int => Unit): Unit =
    if threads == 1 || count <= 1 then Parallel.Alone.each(count)(task)
    else
      val next = AtomicInteger()
      val failure = AtomicReference[Throwable | Null](null)
      val work: Runnable = () =>
        try
          var i = next.getAndIncrement()
          while i < count && failure.get == null do
            task(i)
            i = next.getAndIncrement()
        catch
          case e: Throwable =>
            val _ = failure.compareAndSet(null, e)
      val others =
        Vector.tabulate(Math.min(threads, count) - 1)(i => start(s"helper-${i + 1}", work))
      work.run()
      others.foreach(_.join())
      val thrown = failure.get
      if thrown != null then throw thrown

  def aside(name: String)(task: => Unit): Unit =
    if worksAside then
      val _ = start(name, () => task)

  private def start(name: String, work: Runnable): Thread =
    val thread = Thread(work, s"candela-$name")
    thread.setDaemon(true)
    thread.start()
    thread

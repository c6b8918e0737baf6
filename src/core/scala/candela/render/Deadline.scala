package candela.render

import java.util.concurrent.CountDownLatch
import java.util.concurrent.TimeUnit.NANOSECONDS

/** Acts beside work that takes too long. */
object Deadline:

  /** Runs `body`. If it takes longer, `late` is called; if it has not ended soon after that,
    * `tooLate`.
    *
    * @param nanos time until `late`
    * @param grace nanoseconds from there to `tooLate`
    */
  def during[A](nanos: Long, grace: Long)(late: => Unit, tooLate: => Unit)(body: => A): A =
    val ended = CountDownLatch(1)
    val watch = Thread: () =>
      if !ended.await(nanos, NANOSECONDS) then
        late
        if !ended.await(grace, NANOSECONDS) then tooLate
    watch.setName("candela-deadline")
    watch.setDaemon(true)
    watch.start()
    try body
    finally ended.countDown()

package candela.concurrency

import candela.base.loop

/** Executes divisible work, possibly in parallel. Callers receive one as an argument: only `render`
  * creates threads.
  */
abstract class Parallel:

  /** Maximum number of concurrent tasks. */
  def threads: Int

  /** Runs `task` for each of 0 until `count`, in any order; returns when all are done. Rethrows
    * what a task throws.
    */
  def forEach(count: Int)(task: Int => Unit): Unit

  /** What `task` gives for each of 0 until `count`, in that order. */
  final def map[A](count: Int)(task: Int => A): IndexedSeq[A] =
    val results = java.util.concurrent.atomic.AtomicReferenceArray[A](count)
    forEach(count)(i => results.set(i, task(i)))
    IndexedSeq.tabulate(count)(results.get)

  /** Whether tasks aside are run. */
  def worksAside: Boolean

  /** Runs a task of advantage but no result beside the caller, who does not wait for it; or not at
    * all.
    */
  def aside(name: String)(task: => Unit): Unit

  /** Runs `task` for ranges (from, until) that partition 0 until `count`, each large enough to
    * amortise the call. The partition is unspecified.
    */
  final def ranges(count: Int)(task: (Int, Int) => Unit): Unit =
    val pieces =
      if threads == 1 then 1
      else Math.max(1, Math.min(Parallel.Pieces * threads, count / Parallel.SmallestRange))
    def start(i: Int) = (count.toLong * i / pieces).toInt
    forEach(pieces)(i => task(start(i), start(i + 1)))

object Parallel:

  /** Runs tasks sequentially in the caller's thread, and none aside. */
  val Alone: Parallel = new Parallel:
    def threads: Int = 1
    def forEach(count: Int)(task: Int => Unit): Unit = loop(count)(task(_))
    def worksAside: Boolean = false
    def aside(name: String)(task: => Unit): Unit = ()

  /** Tasks per thread, for load balance. */
  private val Pieces = 4

  private val SmallestRange = 1 << 12

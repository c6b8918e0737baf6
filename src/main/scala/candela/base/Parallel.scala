package candela.base

/** Who does pieces of work, perhaps several at a time. Handed down to whoever has such work: only
  * `render` makes threads.
  */
abstract class Parallel:

  /** So many pieces are done at the same time, at most. */
  def threads: Int

  /** Runs `task` for each of 0 until `count`, in any order, and returns when all are done. What a
    * task throws is thrown here.
    */
  def each(count: Int)(task: Int => Unit): Unit

  /** Runs `task` for ranges (from, until) that make up 0 until `count`, none of them small enough
    * that the calls would count. Which ranges these are is left open.
    */
  final def ranges(count: Int)(task: (Int, Int) => Unit): Unit =
    val pieces =
      if threads == 1 then 1
      else Math.max(1, Math.min(Parallel.Pieces * threads, count / Parallel.SmallestRange))
    def start(i: Int) = (count.toLong * i / pieces).toInt
    each(pieces)(i => task(start(i), start(i + 1)))

object Parallel:

  /** One piece after the other, in the caller's thread. */
  val Alone: Parallel = new Parallel:
    def threads: Int = 1
    def each(count: Int)(task: Int => Unit): Unit = loop(count)(task(_))

  /** For each thread, so that all end at about the same time. */
  private val Pieces = 4

  private val SmallestRange = 1 << 12

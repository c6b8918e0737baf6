package candela.mlt

import candela.sampling.Discrete

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.locks.LockSupport

/** Independent bootstrap paths, which determine the image brightness and the initial states of the
  * chains.
  *
  * Paths come in rounds. The first has the requested count; each later one doubles the total, until
  * the relative standard error of the mean is [[Bootstrap.Precision]], or the total is
  * that of the mutations. Workers that need the result help to compute it; it is bit-identical for
  * any thread count.
  *
  * @param asked     paths of the first round
  * @param mutations total mutations of all chains
  */
private[candela] final class Bootstrap(asked: Int, mutations: Long):
  import Bootstrap.*

  private val maxPaths = Math.max(asked.toLong, Math.min(mutations, MaxPaths)).toInt
  @volatile private var round = Round(asked, Sums(0, 0, 0), None)
  @volatile private var result: Option[Start] = None
  @volatile private var failure: Option[Throwable] = None

  /** The result; none before [[help]] has returned. */
  def start: Option[Start] = result

  /** Helps until the result is known or the rendering is stopped.
    *
    * @param strength brightness of a path by its number
    */
  def help(isStopped: () => Boolean)(strength: Int => Float): Unit =
    try
      while result.isEmpty && !isStopped() do
        work(round, isStopped, strength)
        for e <- failure do throw e
        if result.isEmpty then LockSupport.parkNanos(Pause)
    catch
      case e: Throwable =>
        failure = Some(e)
        throw e

  private def work(round: Round, isStopped: () => Boolean, strength: Int => Float): Unit =
    var batch = round.next.getAndIncrement()
    while batch < round.batches && !isStopped() do
      val end = Math.min(round.strengths.length, (batch + 1) * PartSize)
      var i = batch * PartSize
      while i < end && !isStopped() do
        round.strengths(i) = strength(round.first + i)
        i += 1
      if i == end && round.done.incrementAndGet() == round.batches then finish(round)
      batch = round.next.getAndIncrement()

  private def finish(last: Round): Unit =
    val sums = last.sums
    val starts = last.starts
    val remaining = maxPaths - sums.count
    if remaining <= 0 || (sums.count >= Fewest && sums.relativeError <= Precision) then
      val (first, picks) = starts.getOrElse((last.first, Discrete(last.strengths)))
      result = Some(Start(sums.mean.toFloat, first, picks))
    else round = Round(Math.min(Math.min(sums.count, LargestRound), remaining), sums, starts)

private[candela] object Bootstrap:

  /** Target relative standard error of the brightness. */
  private[candela] val Precision = 0.003

  /** Minimum number of paths for a reliable error estimate. */
  private val Fewest = 1000

  private val MaxPaths = 1L << 30
  private val LargestRound = 1 << 20
  private val PartSize = 256

  /** In nanoseconds; short beside a round. */
  private val Pause = 50_000L

  /** @param mean  mean brightness of a path; 0 if no path carried light
    * @param first number of the path at index 0 of `picks`
    * @param picks distribution of initial states, by brightness
    */
  final class Start(val mean: Float, first: Int, picks: Discrete):
    /** Number of the path sampled by `u`, in [0, 1). */
    def path(u: Float): Int = first + picks.sample(u)

  private final case class Sums(count: Int, total: Double, squares: Double):
    def mean: Double = total / count
    def relativeError: Double =
      val variance = squares / count - mean * mean
      if total > 0 then Math.sqrt(Math.max(0.0, variance) / count) / mean
      else Double.PositiveInfinity

  /** @param previous  sums of the earlier rounds
    * @param earlier initial states of the first earlier round that found light
    */
  private final class Round(size: Int, previous: Sums, earlier: Option[(Int, Discrete)]):
    val strengths = new Array[Float](size)
    val first: Int = previous.count
    val batches: Int = (size + PartSize - 1) / PartSize
    val next = AtomicInteger()
    val done = AtomicInteger()

    /** Sums of all rounds up to this one, which is done. */
    def sums: Sums =
      var total, squares = 0.0
      for s <- strengths do
        total += s
        squares += s.toDouble * s
      Sums(previous.count + size, previous.total + total, previous.squares + squares)

    def starts: Option[(Int, Discrete)] = earlier.orElse:
      Option.when(strengths.exists(_ > 0f))((first, Discrete(strengths)))

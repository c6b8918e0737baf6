package candela.bench.robustness

/** A part of the random trials of a measurement.
  *
  * @param slice which part: each has random numbers of its own
  */
final case class Trials(count: Long, slice: Int):
  /** The seed of this slice's random numbers. */
  def seed(first: Long): Long = first + slice * Trials.Apart
  def draws(first: Long): Draws = Draws(seed(first))

object Trials:
  /** Any odd number but the one that SplittableRandom adds in each step: with that, slices would
    * have the same numbers, one later each.
    */
  private val Apart = 0xd1b54a32d192ed03L

  /** Equal parts of `count` trials, at least one each. */
  def divided(count: Long, parts: Int): Vector[Trials] =
    Vector.tabulate(parts)(k => Trials(Math.max(1L, count / parts), k))

/** How many of some trials failed.
  *
  * @param first what the first failure was, in words
  */
final case class Tally(trials: Long, faults: Long, first: Option[String]):
  def and(next: Tally): Tally =
    Tally(trials + next.trials, faults + next.faults, first.orElse(next.first))

object Tally:
  val Empty: Tally = Tally(0, 0, None)

  /** No fault in a trial. */
  final val Sound = ""

  /** Counts `count` trials; each returns its fault in words, or [[Sound]]. */
  inline def of(count: Long)(inline trial: Long => String): Tally =
    var faults = 0L
    var first = Option.empty[String]
    var i = 0L
    while i < count do
      val fault = trial(i)
      if fault.nonEmpty then
        faults += 1
        if first.isEmpty then first = Some(fault)
      i += 1
    Tally(count, faults, first)

package candela.render

import candela.base.loop

/** Estimates how long samples will take, from the latest ones.
  *
  * Samples are taken in sweeps over the image. A sweep is divided into [[TimeLeft.Slots]] parts of
  * equally many pixels, whose paths cost differently: each has its own pace, that of its latest
  * samples. So a sweep that is half done is compared with the same half of the sweep before. The
  * first samples of a JVM are slow; their pace is forgotten within a part of the time so far.
  *
  * Not thread-safe.
  */
private[render] final class TimeLeft:
  import TimeLeft.*

  // Seconds per sample of all pixels, were all like those of the slot; NaN: not known yet
  private val paces = Array.fill(Slots)(Double.NaN)
  private val measuredAt = new Array[Double](Slots)
  private var sweep = Sweep(0, 1)
  private var samples, time, begun = 0.0
  private var isBegun, hasSwept = false

  // The slot that is being measured
  private var spent, taken = 0.0
  // Of the slots of this sweep that are measured: their paces, and those of the sweep before
  private var newer, older = 0.0
  private var measured = 0

  /** Notes progress.
    *
    * @param samples per pixel until now, of which the last belong to `sweep`
    * @param seconds since the start of rendering
    */
  def add(samples: Double, sweep: Sweep, seconds: Double): Unit =
    if !isBegun then
      // What precedes the first samples doesn't happen again
      if samples > this.samples then
        isBegun = true
        begun = seconds
        enter(sweep)
        this.samples = samples
        time = seconds
      else this.samples = samples
    else if samples > this.samples then
      val pace = (seconds - time) / (samples - this.samples)
      val from = this.samples
      this.samples = samples
      if this.sweep == sweep then advance(sweep.part(from), sweep.part(samples), pace, seconds)
      else if this.sweep.end == sweep.begin then
        advance(this.sweep.part(from), 1, pace, seconds)
        enter(sweep)
        hasSwept = true
        advance(0, sweep.part(samples), pace, seconds)
      else
        // Whole sweeps since the last time
        loop(Slots)(measure(_, pace, seconds))
        enter(sweep)
        hasSwept = true
      time = seconds

  /** Seconds until there are so many samples per pixel; none in the first seconds.
    *
    * @param warm processor time that each worker has had, if known, in seconds: a young JVM gets
    *   faster as it compiles, by as much as was measured
    */
  def until(samples: SampleRange, seconds: Double, warm: Option[Double]): Option[TimeRange] =
    val young = warm.getOrElse(seconds - begun)
    val part = sweep.part(this.samples)
    val isEnough = hasSwept || part >= FirstPart
    Option.when(isBegun && isEnough && Math.min(seconds - begun, young) >= FirstSeconds):
      val square = young * young
      def sooner(left: Double) =
        // Of a long rest of the rendering, most is as fast as it gets
        Iterator.iterate(left)(l => left * Math.exp(-Slow / square * l / (seconds + l)))
          .drop(Steps).next()
      val expected = sooner(paced(samples.expected, seconds))
      val noise = Confidence * (PaceNoise + YoungNoise / square)
      def far(end: Int, sign: Int) =
        if end == Int.MaxValue then Double.PositiveInfinity
        else
          val far = Math.log(Math.max(1e-9, sooner(paced(end, seconds))) / Math.max(1e-9, expected))
          expected * Math.exp(sign * Math.hypot(far, noise))
      TimeRange(expected, far(samples.low, -1), far(samples.high, 1))

  /** Seconds until there are so many samples per pixel, at the present paces. */
  private def paced(samples: Double, seconds: Double): Double =
    val part = sweep.part(this.samples)
    val usual = mean
    val drift = this.drift(usual)
    val at = Math.min((part * Slots).toInt, Slots - 1)
    var rest, all = 0.0
    loop(Slots): i =>
      val known = if paces(i).isNaN then usual else paces(i)
      val pace = if i >= at then known * drift else known
      all += pace
      if i > at then rest += pace
      else if i == at then rest += pace * (at + 1 - part * Slots)
    val inSweep = Math.min(sweep.size, Math.max(0, samples - sweep.begin)) * rest / Slots
    val later = Math.max(0, samples - sweep.end) * all / Slots
    Math.max(0, inSweep + later - (seconds - time))

  /** Samples per pixel and second, recently. */
  def rate: Option[Double] = Option(1 / mean).filter(r => isBegun && r > 0 && !r.isInfinite)

  private def enter(sweep: Sweep): Unit =
    this.sweep = sweep
    newer = 0
    older = 0
    measured = 0
    spent = 0
    taken = 0

  private def advance(from: Double, to: Double, pace: Double, seconds: Double): Unit =
    var at = from
    while at < to do
      val slot = Math.min((at * Slots).toInt, Slots - 1)
      val end = if slot == Slots - 1 then 1.0 else (slot + 1.0) / Slots
      val next = Math.min(to, end)
      spent += pace * (next - at)
      taken += next - at
      if next >= end then
        measure(slot, spent / taken, seconds)
        spent = 0
        taken = 0
      at = if next > at then next else to

  private def measure(slot: Int, pace: Double, seconds: Double): Unit =
    val old = paces(slot)
    if old.isNaN then paces(slot) = pace
    else
      val window = Math.max(ShortestWindow, (seconds - begun) * WindowPart)
      val weight = 1 - Math.exp(-(seconds - measuredAt(slot)) / window)
      paces(slot) = old + (pace - old) * weight
      newer += paces(slot)
      older += old
    measured = slot + 1
    measuredAt(slot) = seconds

  /** By how much paces of this sweep differ from those of the sweep before, which are waiting for
    * their turn. A few slots say little.
    */
  private def drift(usual: Double): Double =
    if hasSwept && newer > 0 then (newer + Doubt * usual) / (older + Doubt * usual) else 1

  /** Of all slots; in the first sweep of the later half of those known, as the first are slow. */
  private def mean: Double =
    val first = if hasSwept then 0 else measured / 2
    var sum = 0.0
    var count = 0
    loop(Slots): i =>
      if i >= first && !paces(i).isNaN then
        sum += paces(i)
        count += 1
    if count > 0 then sum / count else if taken > 0 then spent / taken else Double.NaN

/** Seconds that a rendering is expected to take.
  *
  * @param low with `high`, the 95 % interval
  */
final case class TimeRange(expected: Double, low: Double, high: Double):
  /** Not beyond this. */
  def atMost(seconds: Double): TimeRange =
    TimeRange(Math.min(expected, seconds), Math.min(low, seconds), Math.min(high, seconds))

  /** Whether the whole time is known to a fourth, with 95 %: mostly, then, to an eighth.
    *
    * @param seconds so far
    */
  private[render] def isKnown(seconds: Double): Boolean =
    val all = seconds + expected
    seconds + high <= all * TimeRange.Known && (seconds + low) * TimeRange.Known >= all

  /** Whether its interval says something. */
  private[render] def says(seconds: Double): Boolean =
    seconds + high <= (seconds + low) * TimeRange.Vague

object TimeRange:
  private val Known = 1.25
  private val Vague = 6.0

private[render] object TimeLeft:

  /** Samples `begin` until `end` of each pixel, taken in one sweep over the image. */
  final case class Sweep(begin: Int, end: Int):
    def size: Int = Math.max(1, end - begin)
    def part(samples: Double): Double = Math.min(1, Math.max(0, (samples - begin) / size))

  private val Slots = 64

  /** In seconds: JVMs compile the hot loops meanwhile. */
  private val FirstSeconds = 2.0

  /** The logarithm of the time left is too large by this over the square of the seconds so far, if
    * the rendering is long in comparison: by docs/NOISE.md, "Time left", as are the standard
    * deviations of the logarithm.
    */
  private val Slow = 5.0
  private val YoungNoise = 12.0
  private val PaceNoise = 0.05

  private val Confidence = 1.959964
  private val Steps = 4

  /** Of the first sweep; what follows may be anything if less is known. */
  private val FirstPart = 0.1

  /** Older paces are forgotten within this part of the time so far, but not within a second. */
  private val WindowPart = 0.25
  private val ShortestWindow = 1.0

  /** As many slots as are taken to have the pace of the sweep before. */
  private val Doubt = 4.0

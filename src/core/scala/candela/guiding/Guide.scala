package candela.guiding

import candela.io.{CheckedInput, CheckedOutput}
import candela.math.Vec3
import candela.sampling.SampleHash

/** What the paths of one rendering learn, shared by all workers. Passes end after 1, 2, 4, 8, …
  * samples per pixel: the paths of a pass use the field of those before, and record for the next.
  * No path uses what it recorded itself, so every sample is unbiased. The image is their mean,
  * weighted by [[GuideProgress.weight]], which earlier samples of the same image determine: it is
  * unbiased but for that correlation, which vanishes with more samples. After a quarter of the
  * samples nothing more is learnt; or, if the settings say so, when a pass has brought no more.
  *
  * @param planned samples per pixel
  * @param pixels  of the image
  */
final class Guide(val settings: GuideSettings, planned: Int, pixels: Long):
  import Guide.*
  private val samples = if settings.learnsOn then Int.MaxValue else planned

  private val isLongEnough =
    !settings.adapts || samples >= MinSamples && pixels * samples >= MinPaths

  private var learning: GuideLearning | Null = null
  private var progress = GuideProgress()
  private val memory = GuideMemory()
  @volatile private var current = newPass(GuideField.Start, 0, UsualEvents, lit = 1.0)
  @volatile private var learnt = 0.0
  private var tallies = Vector.empty[GuideTally]

  /** The field to use, and where to record, until the pass ends. */
  def pass: Pass = current

  /** Of the samples until the pass ends, relative to the first; one where few paths are guided, or
    * all count the same.
    */
  def weight: Float =
    val active = current
    if settings.weighs && active.field.guides && active.fraction == 1f then progress.weight else 1f

  /** For a worker. */
  def newTally(): GuideTally = synchronized:
    val tally = GuideTally()
    tallies :+= tally
    tally

  /** What will be learnt. */
  def describe: String =
    val schedule =
      if samples == Int.MaxValue then "learnt until it brings no more"
      else s"learnt in the first ${Math.max(1, lastPass)} of $samples samples"
    if !settings.adapts then s"everywhere, $schedule"
    else if isLongEnough then s"where it pays, $schedule; ends sooner if it does not"
    else "none: the rendering is too short to learn"

  /** Seconds that workers were busy with learning alone. */
  def seconds: Double = learnt

  /** What was learnt; no path may be on its way. */
  def outcome: GuideOutcome =
    val field = current.field
    GuideOutcome(
      samples = current.begun,
      regions = field.bsdfProbabilities.count(_ < 1f),
      allRegions = field.regions,
      lobes =
        field.lobeCounts.zip(field.bsdfProbabilities).collect { case (n, p) if p < 1f => n }.sum,
      bounces = tallies.map(_.bounces).sum,
      guided = tallies.map(_.guided).sum,
      varianceRatio = progress.varianceRatio,
      weight = weight,
      gaveUp = progress.gaveUp
    )

  /** Called when sample number `sample` begins, and no path of an earlier pass is on its way.
    *
    * @param moves called again and again where a pass ends and much is learnt
    * @param isLeft whether to give up what is learnt there: it is learnt again, from the same paths
    * @return false if it was given up
    */
  def beginSample(
      sample: Int,
      moves: () => Unit = () => (),
      isLeft: () => Boolean = () => false
  ): Boolean =
    if isOver(current, sample) then
      val task = synchronized:
        val ending = current
        if learning == null && isOver(ending, sample) then
          learning = GuideLearning(growth(ending, sample))
        learning
      // Else others have just ended the pass
      if task != null && task.help(moves, isLeft) then
        synchronized:
          if isOver(current, sample) then adopt(task.growth, sample)
    !isOver(current, sample)

  private def isOver(pass: Pass, sample: Int): Boolean =
    pass.records != null && sample >= next(pass.begun)

  /** Events per path that found light, in a pass that ends. */
  private def perPath(ending: Pass, sample: Int, events: Int): Double =
    val rate = ending.records.nn.rate
    events / (pixels.toDouble * (sample - ending.begun) * ending.fraction * rate)

  private def growth(ending: Pass, sample: Int): GuideGrowth =
    val events = ending.records.nn.sorted()
    val lit = perPath(ending, sample, events.firsts)
    val records = ending.records.nn
    val counts = records.counts.map(_.toFloat)
    val share = Math.min(1.0, lit)
    val result =
      GuideGrowth(ending.field, events, settings, share, counts, records.costs, records.pathCost)
    if settings.adapts && !progress.isCertain then
      val next = after(ending, result.judged(), sample)
      if next.gaveUp then result.giveUp()
      else if !next.isCertain then result.fitRoughly()
    result

  /** What is known when a pass ends. */
  private def after(ending: Pass, verdict: GuideVerdict, sample: Int): GuideProgress =
    val next =
      if ending.field.guides then progress.after(verdict) else progress.copy(cost = verdict.cost)
    next.copy(gaveUp = settings.adapts && next.givesUp(isLast = !recordsFrom(sample)))

  private def adopt(growth: GuideGrowth, sample: Int): Unit =
    val ending = current
    val eventRate = perPath(ending, sample, growth.events.count)
    val isSettled = settings.learnsOn && settings.adapts && ending.field.guides &&
      sample >= MinSettledSamples && progress.isSettledBy(growth.verdict)
    progress = after(ending, growth.verdict, sample)
    current =
      if progress.gaveUp then Pass(GuideField.Start, sample, fraction = 0f, null)
      else newPass(growth.result(), sample, eventRate, growth.lit, learnsMore = !isSettled)
    for l <- Option(learning) do learnt += l.seconds
    learning = null
    ending.records.nn.release()
    if current.records == null then memory.forget()

  /** The sample before which the last pass ends. */
  private def lastPass: Int = Iterator.iterate(1)(next).takeWhile(goesOn).foldLeft(1)((_, n) => n)

  /** Does a pass that ends then record? The first always ends before the samples do. */
  private def goesOn(end: Int): Boolean = end < samples && (end == 1 || 4L * end <= samples)

  /** Does the pass that begins with this sample record, unless all is learnt? */
  private def recordsFrom(begun: Int): Boolean = isLongEnough && goesOn(next(begun))

  /** @param eventRate events per sample that found light
    * @param lit   part of all paths that has such events
    */
  private def newPass(
      field: GuideField,
      begun: Int,
      eventRate: Double,
      lit: Double,
      learnsMore: Boolean = true
  ): Pass =
    val end = next(begun)
    val learns = learnsMore && recordsFrom(begun)
    val paths = pixels.toDouble * (end - begun)
    val fraction =
      if !learns && !field.guides then 0f
      else if !learns || !settings.adapts || progress.isCertain then 1f
      else
        val isTried = field.guides && goesOn(next(end))
        val trial =
          if progress.isWorthwhile then PromisingPaths
          else if isTried then TrialPaths
          else LearningPaths
        Math.min(1.0, trial / (paths * Math.max(lit, 1e-3))).toFloat
    val rate =
      Math.min(1.0, settings.records / (paths * fraction * Math.max(eventRate, 1e-3))).toFloat
    Pass(field, begun, fraction, if learns then GuideRecords(rate, field.regions, memory) else null)

  /** Writes what was learnt; no path may be on its way. */
  def save(to: CheckedOutput): Unit =
    val active = current
    val records = active.records
    to.int(active.begun)
    active.field.save(to)
    progress.save(to)
    to.long(tallies.map(_.bounces).sum)
    to.long(tallies.map(_.guided).sum)
    to.float(active.fraction)
    to.float(if records == null then 0f else records.rate)
    if records != null then records.save(to)

  /** Continues from what was learnt. */
  def load(from: CheckedInput): Unit =
    val begun = from.int()
    val field = GuideField.load(from)
    progress = GuideProgress.load(from)
    val tally = newTally()
    tally.bounces = from.long()
    tally.guided = from.long()
    val fraction = from.float()
    val rate = from.float()
    val records = if rate == 0f then null else GuideRecords(rate, field.regions, memory)
    if records != null then records.load(from)
    current = Pass(field, begun, fraction, records)

object Guide:
  /** A pass of training.
    *
    * @param begun    its first sample
    * @param fraction of the paths that use the field, and record
    * @param records  null: nothing more is learnt
    */
  final class Pass private[guiding] (
      val field: GuideField,
      val begun: Int,
      private[guiding] val fraction: Float,
      private[guiding] val records: GuideRecords | Null
  ):
    /** Does the path use the field whose camera ray this is? Chosen at random. */
    def includes(origin: Vec3, direction: Vec3): Boolean =
      fraction == 1f || fraction > 0f && chance(origin, direction) < fraction

    /** Does the path record, if it uses the field? */
    def learnsFrom(origin: Vec3, direction: Vec3): Boolean =
      val to = records
      to != null && (to.rate == 1f || chance(origin, direction) < fraction * to.rate)

    /** Where a worker records; null: nothing more is learnt. */
    def newPart(): GuideRecords.Part | Null =
      val to = records
      if to == null then null else to.newPart()

  /** Of a path: uniform from 0 to 1. Rays of orthographic cameras differ in their origins only. */
  private def chance(origin: Vec3, direction: Vec3): Float =
    def mixed(hash: Int, v: Vec3) =
      def bits(x: Float) = java.lang.Float.floatToRawIntBits(x)
      SampleHash.mix(bits(v.x) ^ SampleHash.mix(bits(v.y) ^ SampleHash.mix(bits(v.z) ^ hash)))
    SampleHash.toUnit(mixed(mixed(0, origin), direction))

  /** Samples per pixel, and paths, of a rendering in which learning may pay. */
  private val MinSamples = 16
  private val MinPaths = 1 << 17

  /** Passes that end before are short: what they learn costs little, and brings much later. */
  private val MinSettledSamples = 32

  /** Paths of a pass that learn and find light, about, until it is certain that guiding pays: of
    * the first pass, and of the last that learns, whose field is that of all later paths.
    */
  private val LearningPaths = 1 << 15

  /** Likewise, of those in between. */
  private val TrialPaths = 1 << 14

  /** Likewise, where it has paid, but not clearly: of a short rendering nearly all. */
  private val PromisingPaths = 1 << 17

  /** Events per sample that find light, before they were counted. */
  private val UsualEvents = 3.0

  /** The sample with which the next pass begins. */
  private def next(begun: Int): Int = Math.max(1L, Math.min(2L * begun, Int.MaxValue)).toInt

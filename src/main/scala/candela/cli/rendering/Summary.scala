package candela.cli.rendering

import candela.base.Figures
import candela.diagnostics.Code
import candela.cli.options.Options
import candela.cli.terminal.{ProblemText, Terminal}
import candela.job.{GoalRule, Prepared, StrategyFiles}
import candela.measure.Interval
import candela.render.{DiscardedSamples, Rendering}
import candela.render.storage.FilmFile

import java.nio.file.Path

/** The final lines of a rendering. */
object Summary:

  /** `wrote x.exr, x.png  256x256, 64 spp, 3.2 s, 1.31 M samples/s, 5.20 M rays/s, error 2.1 %`;
    * of a rendering that ended before its first sample or was interrupted, the samples done.
    *
    * @param standIns number of missing items replaced by placeholders
    * @param isLate   whether its time was over
    * @param noise    what is said of the error, if it was estimated
    * @param shards   number of renderings that share the samples
    * @param ending   option that ended it, if it had a goal
    */
  def result(
      written: Vector[Path],
      r: Rendering,
      standIns: Int = 0,
      isLate: Boolean = false,
      noise: String = "",
      shards: Int = 1,
      ending: Option[String] = None
  ): String =
    val noiseNote = if noise.isEmpty then "" else s", $noise"
    val isMet = ending.contains(GoalRule.Ending.Error.setting) && r.samplesDone == r.earlier
    val endNote = ending.fold(""): option =>
      if isMet then s"; --$option was reached already" else s"; ended by --$option"
    val missing = noiseNote + placeholders(standIns) + darkness(r) + endNote
    val names = StrategyFiles.listed(written)
    if r.isComplete && r.seconds == 0 then
      val done = if r.samplesDone == 0 then "less than 1" else ofShards(r.samplesDone, shards)
      s"wrote $names  ${r.film.width}x${r.film.height}, $done spp$missing"
    else if r.isComplete then
      val rates = s"${rate(r.samplesTaken, r)} samples/s, ${rate(r.rays, r)} rays/s"
      val size = s"${r.film.width}x${r.film.height}"
      val seconds = Figures.duration(r.seconds)
      val done =
        if r.takenShare < 1 && r.earlier == 0 then
          s"${average(r.samplesDone * r.takenShare / shards)} of ${r.samplesDone}"
        else ofShards(r.samplesDone, shards)
      s"wrote $names  $size, $done spp${ofThisRun(r, shards)}, $seconds, " +
        s"$rates$missing"
    else
      val done = if r.samplesDone == 0 then "less than 1" else shared(r.samplesDone, shards)
      val number =
        if !r.isOpenEnded then s"$done of ${r.samplesPerPixel} samples"
        else if r.samplesDone > 1 then s"$done samples"
        else s"$done sample"
      s"${ended(isLate)}: wrote $names with $number per pixel${ofThisRun(r, shards)}$missing"

  /** `8.77`: three digits. */
  private def average(samples: Double): String =
    Figures.general(BigDecimal(samples).round(java.math.MathContext(3)).toDouble)

  /** `error 4.6 % (3.3 to 5.2 %)`: with the interval, where that is wider than 15 %; of too few
    * samples for an estimate, and of images without finite values, `error unknown`.
    *
    * @param error    relative error, if it is known
    * @param interval of the relative MSE, which is the error's square; with 95 % confidence
    */
  def noise(samples: Int, error: Option[Double], interval: Option[Interval]): String =
    error.filter(_ => samples >= GoalRule.MinSamples).fold(unknown(samples)):
      estimated(_, interval)

  private def unknown(samples: Int): String =
    if samples < GoalRule.MinSamples then "error unknown: too few samples" else "error unknown"

  private def estimated(error: Double, interval: Option[Interval]): String =
    val limits = interval.filter(_.isKnown).map(i => (Math.sqrt(i.low), Math.sqrt(i.high)))
    def isWide(limit: Double) = Math.abs(limit / error - 1) > MaxOmitted
    val range = limits match
      case Some((low, high)) if isWide(low) || isWide(high) =>
        s" (${Figures.percentage(low).stripSuffix(" %")} to ${Figures.percentage(high)})"
      case _ => ""
    s"error ${Figures.percentage(error)}$range"

  /** An interval whose limits differ less from the error is not shown. */
  private val MaxOmitted = 0.15

  private def ended(isLate: Boolean) = if isLate then "out of time" else "interrupted"

  /** The seconds are those of this run alone. */
  private def ofThisRun(r: Rendering, shards: Int): String =
    if r.earlier == 0 then ""
    else if r.samplesDone == r.earlier then " (none added)"
    else s" (${shared(r.samplesDone - r.earlier, shards)} in this run)"

  private def placeholders(count: Int): String =
    if count > 0 then s", ${Figures.count(count, "placeholder")}" else ""

  /** A discarded sample counts as black. */
  private def darkness(r: Rendering): String =
    val discarded = r.discarded.fold(0L)(_.count)
    val done = Math.max(r.samplesTaken, r.film.width.toLong * r.film.height * r.samplesDone)
    if discarded * SamplesPerDiscarded <= done then ""
    else
      val share = Figures.percentage(discarded.toDouble / done)
      s"; the image is too dark: $share of its samples were discarded"

  /** One discarded sample among so many is not worth a word in the last line. */
  private val SamplesPerDiscarded = 1000

  /** Of images that a rendering without samples did not replace. */
  def unreplaced(images: Vector[Path], r: Rendering, isLate: Boolean = false): String =
    val reason = if r.isComplete then "" else s"${ended(isLate)}: "
    s"${reason}kept ${images.mkString(", ")}: the new image has less than 1 sample per pixel"

  /** `continuing x.film at 12 samples per pixel`; of a shard, `at 3 of 12 samples per pixel` */
  def continues(film: FilmFile): String =
    val done = ofShards(film.header.done, film.header.count)
    s"continuing ${film.path} at $done samples per pixel"

  /** The samples of one of the renderings that share them. */
  private def shared(samples: Int, shards: Int): String =
    Figures.general(samples.toDouble / shards)

  private def ofShards(samples: Int, shards: Int): String =
    if shards == 1 then samples.toString else s"${shared(samples, shards)} of $samples"

  /** The last lines of a rendering.
    *
    * @param written its files
    * @param after   the phases after rendering, with their seconds
    * @param isLate  whether its time was over
    * @param noise   what is said of the error, if it was estimated
    * @param ending  option that ended it, if it had a goal
    */
  def print(
      options: Options,
      terminal: Terminal,
      written: Vector[Path],
      prepared: Prepared,
      rendering: Rendering,
      after: Vector[(String, Double)] = Vector.empty,
      isLate: Boolean = false,
      noise: String = "",
      ending: Option[String] = None
  ): Unit =
    for r <- rendering.discarded do
      terminal.err.println(discarded(r, isTraceable = !options.settings.preview))
    if !options.quiet && written.nonEmpty then
      if options.verbose then
        terminal.err.println(phases(prepared, rendering, after))
        rendering.learned.foreach(o => terminal.err.println(Learning.summary(o)))
      terminal.out.println(result(
        written,
        rendering,
        prepared.standIns,
        isLate,
        noise,
        options.film.shard.count,
        ending
      ))
      terminal.out.flush()

  private def phases(
      prepared: Prepared,
      rendering: Rendering,
      after: Vector[(String, Double)]
  ): String =
    val durations = Vector(
      "parse" -> prepared.readSeconds,
      "build" -> prepared.buildSeconds,
      "render" -> rendering.seconds
    ) ++ after
    durations.map((phase, seconds) => s"$phase ${Figures.duration(seconds)}").mkString(", ")

  /** @param isTraceable whether `render` can trace the same sample: not of a smaller image */
  def discarded(r: DiscardedSamples, isTraceable: Boolean): String =
    val material = if r.material < 0 then "" else s", material ${r.material}"
    val options = s"--pixel ${r.x},${r.y} --sample ${r.sample} --debug"
    val advice = if isTraceable then s"; trace it with `candela render $options`" else ""
    val message = s"warning: ${Figures.count(r.count, "sample")} discarded: NaN or infinite, " +
      s"the first at pixel (${r.x}, ${r.y}), sample ${r.sample}$material$advice"
    ProblemText.numbered(message, Code.DiscardedSamples)

  private def rate(count: Long, r: Rendering): String =
    Figures.metric(count / Math.max(r.seconds, 1e-9))

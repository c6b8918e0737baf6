package candela.cli.terminal

import candela.base.Figures
import candela.render.Progress

import java.util.Locale

/** Progress of a rendering: one redrawn line on a terminal, occasional lines in a log.
  *
  * No library's progress bar: those support terminals only, and a log must get no carriage returns.
  *
  * @param isForPrograms whether another program reads the log, to show progress itself: more lines
  */
final class ProgressLine(err: Printer, isInteractive: Boolean, isForPrograms: Boolean = false):
  import ProgressLine.*

  private var shownAt = 0.0
  private var shownSteps = 0
  private var shownLength = 0

  def update(progress: Progress): Unit = if isInteractive then redraw(progress) else log(progress)

  /** Clears the line for subsequent output. */
  def finish(): Unit =
    if shownLength > 0 then
      err.control("\r" + " " * shownLength + "\r")
      err.flush()
      shownLength = 0

  private def redraw(progress: Progress): Unit =
    if progress.seconds - shownAt >= RedrawSeconds then
      val text = bar(progress)
      err.control("\r" + text.padTo(shownLength, ' '))
      err.flush()
      shownAt = progress.seconds
      shownLength = text.length

  private def log(progress: Progress): Unit =
    val steps = (progress.fraction * LogSteps).toInt
    val isDue =
      if isForPrograms then progress.seconds - shownAt >= ProgramSeconds
      else steps > shownSteps && steps < LogSteps && progress.seconds - shownAt >= LogSeconds
    if isDue then
      err.println(if isForPrograms then fineLine(progress) else line(progress))
      shownAt = progress.seconds
      shownSteps = steps

object ProgressLine:

  /** Slow enough not to flood a remote terminal. */
  private val RedrawSeconds = 0.1
  private val LogSeconds = 10.0
  private val ProgramSeconds = 0.25

  /** Maximum number of lines in a log. */
  private val LogSteps = 10
  private val BarWidth = 28
  private val NarrowWidth = 12

  /** Of bar and speed, in lines narrower than 80 columns. */
  private val BarRoom = 64

  /** In seconds; more is shown as this. */
  private val LongestLeft = 359_999.0

  /** `render  42%  12.0 s, 1.31 M samples/s, 0:17 left`; or, of an error that is to be reached,
    * `… 0:17 left, until 96 to 141 spp`.
    */
  def line(progress: Progress): String =
    val seconds = Figures.duration(progress.seconds)
    s"render ${percent(progress)}  $seconds, ${speed(progress)}${end(progress)}"

  /** With hundredths of a percent, for programs: `render 42.17%  12.0 s, …`. */
  private def fineLine(p: Progress): String =
    val percentage = "%5.2f%%".formatLocal(Locale.ROOT, p.fraction * 100)
    s"render $percentage  ${Figures.duration(p.seconds)}, ${speed(p)}${end(p)}"

  /** Narrower than 80 columns: `render  42% [========>          ] 1.31 M samples/s, 0:17 left`, or
    * `… 1.31 M samples/s, error 1.23 %, 0:17 left`.
    */
  def bar(progress: Progress): String =
    val isLong = progress.outlook.hasGoal || progress.outlook.error.isDefined
    val room = BarRoom - speed(progress).length
    val width = Math.max(1, Math.min(room, if isLong then NarrowWidth else BarWidth))
    val full = (progress.fraction * width).toInt
    val drawn = if full < width then "=" * full + ">" else "=" * full
    s"render ${percent(progress)} [${drawn.padTo(width, ' ')}] ${speed(progress)}"

  private def percent(p: Progress): String =
    "%3d%%".formatLocal(Locale.ROOT, (p.fraction * 100).toInt)

  private def speed(p: Progress): String =
    if p.done == 0 then "starting"
    else
      val rate = p.outlook.rate.getOrElse(p.done / Math.max(p.seconds, 1e-9))
      val error = p.outlook.error.fold("")(e => s", error ${Figures.percentage(e)}")
      s"${Figures.metric(rate)} samples/s$error${timeLeft(p)}"

  /** At how many samples per pixel a goal ends it, if that is known. */
  private def end(p: Progress): String = p.outlook.samples.fold(""): s =>
    if s.high == Int.MaxValue then s", until ${s.low} spp or more"
    else if s.low == s.high then s", until ${s.expected} spp"
    else s", until ${s.low} to ${s.high} spp"

  private def timeLeft(p: Progress): String = p.outlook.left match
    case Some(seconds) => s", ${Figures.clock(Math.min(seconds, LongestLeft))} left"
    case None => if p.outlook.hasGoal then ", time left unknown" else ""

package candela.cli

import candela.render.Progress

import java.util.Locale

/** Progress of a rendering: one redrawn line on a terminal, occasional lines in a log.
  *
  * No library's progress bar: those support terminals only, and a log must get no carriage returns.
  */
final class ProgressLine(err: Printer, isInteractive: Boolean):
  import ProgressLine.*

  private var shownAt = 0.0
  private var shownSteps = 0
  private var shownLength = 0

  /** @param outlook if the rendering may end before the planned samples are taken */
  def update(progress: Progress, outlook: Option[Outlook] = None): Unit =
    if isInteractive then redraw(progress, outlook) else log(progress, outlook)

  /** Clears the line for subsequent output. */
  def finish(): Unit =
    if shownLength > 0 then
      err.control("\r" + " " * shownLength + "\r")
      err.flush()
      shownLength = 0

  private def redraw(progress: Progress, outlook: Option[Outlook]): Unit =
    if progress.seconds - shownAt >= RedrawSeconds then
      val text = bar(progress, outlook)
      err.control("\r" + text.padTo(shownLength, ' '))
      err.flush()
      shownAt = progress.seconds
      shownLength = text.length

  private def log(progress: Progress, outlook: Option[Outlook]): Unit =
    val steps = (fraction(progress, outlook) * LogSteps).toInt
    if steps > shownSteps && steps < LogSteps && progress.seconds - shownAt >= LogSeconds then
      err.println(line(progress, outlook))
      shownAt = progress.seconds
      shownSteps = steps

object ProgressLine:

  /** Slow enough not to flood a remote terminal. */
  private val RedrawSeconds = 0.1
  private val LogSeconds = 10.0

  /** Maximum number of lines in a log. */
  private val LogSteps = 10
  private val BarWidth = 28
  private val NarrowWidth = 12

  /** `render  42%  12.0 s, 1.31 M samples/s, 0:17 left` */
  def line(progress: Progress, outlook: Option[Outlook] = None): String =
    val seconds = Figures.duration(progress.seconds)
    s"render ${percent(progress, outlook)}  $seconds, ${speed(progress, outlook)}"

  /** Narrower than 80 columns: `render  42% [========>          ] 1.31 M samples/s, 0:17 left`, or
    * `… 1.31 M samples/s, error 1.23 %, 0:17 left`.
    */
  def bar(progress: Progress, outlook: Option[Outlook] = None): String =
    val width = if outlook.isDefined then NarrowWidth else BarWidth
    val full = (fraction(progress, outlook) * width).toInt
    val drawn = if full < width then "=" * full + ">" else "=" * full
    val bar = drawn.padTo(width, ' ')
    s"render ${percent(progress, outlook)} [$bar] ${speed(progress, outlook)}"

  private def fraction(p: Progress, outlook: Option[Outlook]): Double =
    outlook.flatMap(_.secondsLeft) match
      case Some(left) => p.seconds / Math.max(p.seconds + left, 1e-9)
      case None => if p.total == 0 then 1 else p.done.toDouble / p.total

  private def percent(p: Progress, outlook: Option[Outlook]): String =
    "%3d%%".formatLocal(Locale.ROOT, (fraction(p, outlook) * 100).toInt)

  private def speed(p: Progress, outlook: Option[Outlook]): String =
    if p.done == 0 then "starting"
    else
      val rate = p.done / Math.max(p.seconds, 1e-9)
      val left = outlook.flatMap(_.secondsLeft).getOrElse((p.total - p.done) / rate)
      val error = outlook.flatMap(_.error).fold("")(e => s"error ${Figures.percentage(e)}, ")
      s"${Figures.metric(rate)} samples/s, $error${Figures.clock(left)} left"

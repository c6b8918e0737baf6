package candela.cli.terminal

import candela.base.Figures
import candela.render.Background
import candela.settings.BuildStages

/** Shows the stage before rendering that takes long: one redrawn line on a terminal, which it
  * clears, and a line every ten seconds in a log.
  */
final class StageLine(err: Printer, isInteractive: Boolean, seconds: () => Double)
    extends BuildStages:
  import StageLine.*

  def during[A](stage: String)(body: => A): A =
    val start = seconds()
    var shownLength = 0
    var lines = 0

    def refresh(): Unit =
      val passed = seconds() - start
      val text = s"$stage  ${Figures.duration(passed)}"
      if isInteractive && passed >= FirstSeconds then
        err.control("\r" + text.padTo(shownLength, ' '))
        err.flush()
        shownLength = text.length
      else if !isInteractive && passed >= LogSeconds * (lines + 1) then
        err.println(text)
        lines += 1

    val showing = Background.repeat("stage", MillisBetween)(() => refresh())
    try body
    finally
      showing.close()
      if shownLength > 0 then
        err.control("\r" + " " * shownLength + "\r")
        err.flush()

object StageLine:
  def apply(terminal: Terminal): StageLine =
    new StageLine(terminal.err, terminal.isInteractive, () => System.nanoTime * 1e-9)

  /** Shorter stages are not shown. */
  private val FirstSeconds = 0.3
  private val LogSeconds = 10.0
  private val MillisBetween = 100L

package candela.cli.terminal

import candela.cli.Captured
import candela.render.{Outlook, Progress, SampleRange}

import org.scalatest.funsuite.AnyFunSuite

class ProgressLineSuite extends AnyFunSuite:

  private def shown(isInteractive: Boolean)(use: ProgressLine => Unit): String =
    val captured = Captured()
    use(ProgressLine(captured.terminal.err, isInteractive))
    captured.err

  test("a line has percentage, seconds, samples per second and the time left"):
    val outlook = Outlook(Some(6.0))
    assert(ProgressLine.line(Progress(4_000_000, 10_000_000, 4.0, outlook)) ==
      "render  40%  4.0 s, 1.00 M samples/s, 0:06 left")

  test("while the time left is not known, nothing is said of it"):
    assert(ProgressLine.line(Progress(4_000_000, 10_000_000, 4.0)) ==
      "render  40%  4.0 s, 1.00 M samples/s")

  test("the speed is that of the latest samples, if it is known"):
    val outlook = Outlook(Some(3.0), rate = Some(2e6))
    assert(ProgressLine.line(Progress(4_000_000, 10_000_000, 4.0, outlook)) ==
      "render  40%  4.0 s, 2.00 M samples/s, 0:03 left")

  test("a bar is as full as the rendering"):
    assert(ProgressLine.bar(Progress(500, 1000, 2.0, Outlook(Some(2.0)))) ==
      "render  50% [==============>             ] 250 samples/s, 0:02 left")
    assert(ProgressLine.bar(Progress(1000, 1000, 2.0, Outlook(Some(0.0)))) ==
      "render 100% [============================] 500 samples/s, 0:00 left")

  test("a rendering that ends by time or error shows what remains until then, and the error"):
    def outlook(error: Option[Double]) = Outlook(Some(6.0), None, error, hasGoal = true)
    val progress = Progress(4_000_000, 1_000_000_000, 2.0, outlook(Some(0.01234)))
    assert(ProgressLine.line(progress) ==
      "render  25%  2.0 s, 2.00 M samples/s, error 1.23 %, 0:06 left")
    assert(ProgressLine.bar(progress) ==
      "render  25% [===>        ] 2.00 M samples/s, error 1.23 %, 0:06 left")
    val unknown = progress.copy(outlook = outlook(None))
    assert(ProgressLine.bar(unknown).endsWith("M samples/s, 0:06 left"))
    assert(ProgressLine.bar(progress.copy(outlook = Outlook(hasGoal = true))) ==
      "render   0% [>           ] 2.00 M samples/s, time left unknown")

  test("logs also tell the samples at which an error is expected to end it"):
    def line(range: SampleRange) =
      val outlook = Outlook(Some(6.0), hasGoal = true, samples = Some(range))
      ProgressLine.line(Progress(4_000_000, 1_000_000_000, 2.0, outlook))
    assert(line(SampleRange(112, 90, 140)).endsWith("0:06 left, until 90 to 140 spp"))
    assert(line(SampleRange(112, 112, 112)).endsWith("left, until 112 spp"))
    assert(line(SampleRange(112, 90, Int.MaxValue)).endsWith("left, until 90 spp or more"))

  test("before the first sample there is no speed"):
    assert(ProgressLine.bar(Progress(0, 1000, 0.5)) ==
      "render   0% [>                           ] starting")

  test("the bar fits into 80 columns for long renderings too"):
    for hasGoal <- Vector(false, true) do
      val outlook = Outlook(Some(1e9), Some(123.4e6), Some(0.0123), hasGoal)
      val progress = Progress(123_456_789, 99_999_999_999L, 99_999.0, outlook)
      assert(ProgressLine.bar(progress).length < 80)

  test("a log that a program reads gets four lines a second, with hundredths of a percent"):
    val captured = Captured()
    val line = ProgressLine(captured.terminal.err, isInteractive = false, isForPrograms = true)
    for i <- 1 to 1000 do line.update(Progress(i, 10_000, i * 0.125))
    val lines = captured.err.linesIterator.toVector
    assert(lines.size == 500 && lines.head == "render  0.02%  0.25 s, 8 samples/s")
    assert(lines.last == "render 10.00%  2:05, 8 samples/s", lines.last)

  test("a log gets plain lines, at most one in ten seconds and for a tenth of the work"):
    val text = shown(isInteractive = false): line =>
      for i <- 0 to 1000 do line.update(Progress(i, 1000, i * 0.2))
      line.finish()
    assert(!text.contains('\r'))
    val percents = text.linesIterator.map(_.slice(7, 11).trim).toVector
    assert(percents == Vector("10%", "20%", "30%", "40%", "50%", "60%", "70%", "80%", "90%"))

  test("a log gets nothing about a rendering of seconds"):
    val text = shown(isInteractive = false): line =>
      for i <- 0 to 100 do line.update(Progress(i, 100, i * 0.05))
    assert(text == "")

  test("a terminal is redrawn at most ten times a second"):
    val text = shown(isInteractive = true): line =>
      for i <- 1 to 1000 do line.update(Progress(i, 1000, i * 0.001))
    val drawings = text.count(_ == '\r')
    assert(drawings >= 8 && drawings <= 10)

  test("a shorter line covers a longer one, and the end leaves the line empty"):
    val long = Progress(1, 100_000_000, 1000.0, Outlook(Some(1e11)))
    val short = Progress(99_999_999, 100_000_000, 2000.0)
    val text = shown(isInteractive = true): line =>
      line.update(long)
      line.update(short)
      line.finish()
    val Array("", first, second, blank) = text.split("\r"): @unchecked
    assert(first.trim == ProgressLine.bar(long))
    assert(second.length == first.length)
    assert(second.trim == ProgressLine.bar(short))
    assert(blank == " " * ProgressLine.bar(short).length || blank == " " * first.length)
    assert(text.endsWith("\r"))

package candela.cli

import java.util.{Timer, TimerTask}

import candela.cli.options.{Command, CommandTable, PbrtOptions}
import candela.cli.terminal.{ExitCode, Interrupts}
import candela.render.Cancellation

/** Runs command lines that may be anything, for the fuzzer. */
object AnyCommand:

  /** A word that a command understands.
    *
    * @param value what follows it, as the help calls it
    */
  final case class Known(word: String, value: Option[String])

  /** The options of each command; those of pbrt's command lines belong to `render`. */
  val options: Map[String, Vector[Known]] =
    CommandTable.rows.map: row =>
      val own = row.options.map(o => Known(s"--${o.name}", o.valueName))
      val pbrt =
        for o <- PbrtOptions.all if row.command == Command.Render
        yield Known(s"--${o.name}", Option.when(o.takesValue)(o.value))
      row.command.word -> (own ++ pbrt).distinct
    .toMap

  /** What is wrong with the way in which a command ends, if it is; a rendering that takes longer
    * than ten milliseconds is interrupted.
    */
  def wrong(words: Seq[String]): Option[String] =
    val captured = Captured(interrupts = Soon)
    val code = Main.run(words, captured.terminal)
    val err = captured.err
    def about(what: String) = Some(s"$what, exit code $code: ${err.take(2000)}")
    if !Codes(code) then about("the exit code is none of those of bad input")
    else if err.contains("bug in Candela") then about("a bug")
    else if err.linesIterator.exists(_.startsWith("\tat ")) then about("a stack trace")
    else if (code == 1 || code == 2) && err.isBlank && captured.out.isBlank then about("no message")
    else if err.exists(controls) then about("a control character")
    else None

  private val Codes = Set(0, 1, 2, ExitCode.Interrupted.number)

  private def controls(c: Char): Boolean = Character.isISOControl(c) && c != '\n' && c != '\t'

  private object Soon extends Interrupts:
    private val timer = Timer("interrupts", true)

    def during[A](cancellation: Cancellation)(body: => A): A =
      val task = new TimerTask:
        def run(): Unit = cancellation.request()
      timer.schedule(task, 10)
      try body
      finally
        val _ = task.cancel()
        val _ = timer.purge()

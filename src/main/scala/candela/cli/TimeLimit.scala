package candela.cli

import candela.diagnostics.{Allowance, Limit, Problem, SceneError}
import candela.cli.options.{Command, FilmOptions, Options}
import candela.cli.terminal.{ExitCode, Interrupts, ProblemText, Terminal}
import candela.render.{Cancellation, Deadline}

import scala.collection.mutable

/** Ends a run whose time is over: parsing and building included, whatever they do. */
private[cli] object TimeLimit:

  /** Runs a command within the time of its options. */
  def during(options: Options, terminal: Terminal)(run: (Options, Terminal) => ExitCode): ExitCode =
    options.control.limits.effective.get(Limit.Time) match
      case None => run(options, terminal)
      case Some(limit) =>
        val nanos = limit * 1_000_000
        val timed = TimedInterrupts(terminal.interrupts, Allowance.outOfTime(limit))
        val limits = options.control.limits.started
        def quit() =
          ProblemText.print(timed.problem, terminal.err, terminal.hasColor)
          terminal.err.flush()
          terminal.interrupts.quit(ExitCode.BadInput)
        Deadline.during(nanos, grace(options))(timed.expire(), quit()):
          run(options.controlling(_.copy(limits = limits)), terminal.interruptedBy(timed))

  /** Nanoseconds for an orderly end; a film that was asked for may have to wait for its disk. */
  private def grace(options: Options): Long =
    val keepsFilm = options.command == Command.Resume || FilmOptions.asksForFilm(options)
    if keepsFilm then 5_000_000_000L else 700_000_000L

/** Cancels renderings when the time is over, too.
  *
  * @param problem what is then said
  */
private final class TimedInterrupts(inner: Interrupts, val problem: Problem) extends Interrupts:
  private val running = mutable.Set.empty[Cancellation]
  private var isOver = false

  def expire(): Unit = synchronized:
    isOver = true
    running.foreach(_.request())

  def during[A](cancellation: Cancellation)(body: => A): A =
    synchronized:
      running += cancellation
      if isOver then cancellation.request()
    try inner.during(cancellation)(body)
    finally synchronized(running -= cancellation): Unit

  override def checkTime(): Unit = if synchronized(isOver) then throw SceneError(problem)

  override def quit(code: ExitCode): Unit = inner.quit(code)

  override def quitting(): Unit = inner.quitting()

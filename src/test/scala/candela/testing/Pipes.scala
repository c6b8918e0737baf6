package candela.testing

import java.nio.file.Path

import scala.util.Try

/** Named pipes, and work that they may block for ever. */
object Pipes:

  /** Whether a pipe was made: not on every system. */
  def make(file: Path): Boolean =
    Try(ProcessBuilder("mkfifo", file.toString).start().waitFor()).toOption.contains(0)

  /** The result of work that must not wait for a pipe: it ends in milliseconds, or never. */
  def unblocked[A](work: => A): A =
    @volatile var result = Option.empty[Try[A]]
    val thread = Thread(() => result = Some(Try(work)))
    thread.setDaemon(true)
    thread.start()
    thread.join(Long)
    result.getOrElse(throw AssertionError("it waits for a pipe")).get

  /** In milliseconds, for a machine that is busy. */
  private val Long = 60_000L

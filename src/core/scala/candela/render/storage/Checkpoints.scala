package candela.render.storage

import candela.io.WholeFile
import candela.render.{Checkpointer, RenderState}

import java.io.IOException

/** Saves a rendering to a film file at intervals, and at the end.
  *
  * @param header of the state, given the samples that every pixel has
  * @param from   the saved state to continue from, if any
  * @param every  seconds between two copies; none: as often as is worth it
  * @param warn   receives the reasons why a copy can't be written
  */
final class Checkpoints(
    writer: FilmWriter,
    header: Int => FilmHeader,
    from: Option[FilmFile],
    every: Option[Double],
    warn: String => Unit
) extends Checkpointer:
  import Checkpoints.*
  private var lastWritten = System.nanoTime
  private var pause = 0.0
  private var isWritten = false
  private var reason = ""

  /** Why the last copy could not be written; empty if it was. */
  def failure: String = reason

  def restore(state: RenderState): Unit = from.foreach(_.load(state))

  def isDue: Boolean =
    secondsSince(lastWritten) >= every.getOrElse(Math.max(DefaultSeconds, pause / LargestShare))

  def save(state: RenderState): Unit =
    val start = System.nanoTime
    isWritten = succeeds(writer.write(header(state.samplesDone), state))
    pause = secondsSince(start)

  def discard(): Unit =
    isWritten = succeeds:
      throw IOException("a sample did not end in time; the last copy is kept, if there is one")

  def finish(): Unit =
    if isWritten then
      val _ = succeeds(writer.commit())
    lastWritten = System.nanoTime

  private def succeeds(body: => Unit): Boolean =
    try
      body
      reason = ""
    catch
      case e: IOException =>
        val message = WholeFile.reason(e)
        if message != reason then warn(message)
        reason = message
    reason.isEmpty

  private def secondsSince(nanos: Long): Double = (System.nanoTime - nanos) * 1e-9

object Checkpoints:
  /** Shortest interval, if the user gives none. */
  private val DefaultSeconds = 60.0

  /** Largest share of the time that workers may pause. */
  private val LargestShare = 0.005

package candela.render.storage

import candela.base.WholeFile
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
  private var last = System.nanoTime
  private var pause = 0.0
  private var isWritten = false
  private var reason = ""

  /** Why the last copy could not be written; empty if it was. */
  def failure: String = reason

  def restore(state: RenderState): Unit = from.foreach(_.load(state))

  def isDue: Boolean = since(last) >= every.getOrElse(Math.max(Usual, pause / LargestShare))

  def save(state: RenderState): Unit =
    val begin = System.nanoTime
    isWritten = tried(writer.write(header(state.samplesDone), state))
    pause = since(begin)

  def lose(): Unit =
    isWritten = tried:
      throw IOException("a sample did not end in time; the last copy is kept, if there is one")

  def finish(): Unit =
    if isWritten then
      val _ = tried(writer.commit())
    last = System.nanoTime

  private def tried(body: => Unit): Boolean =
    try
      body
      reason = ""
    catch
      case e: IOException =>
        val why = WholeFile.reason(e)
        if why != reason then warn(why)
        reason = why
    reason.isEmpty

  private def since(nanos: Long): Double = (System.nanoTime - nanos) * 1e-9

object Checkpoints:
  /** In seconds. */
  private val Usual = 60.0

  /** Largest share of the time that workers may pause. */
  private val LargestShare = 0.005

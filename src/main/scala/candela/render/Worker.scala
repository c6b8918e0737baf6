package candela.render

/** One of several that make the same image: takes pieces of work from the board, wave by wave, and
  * owns all that it scribbles on.
  */
private[render] abstract class Worker(schedule: Schedule, board: Board) extends Runnable:
  def raysTraced: Long
  def refused: Option[Refused]

  /** False if it was told to stop on the way. */
  protected def work(piece: Int, wave: Int): Boolean

  /** Says where the worker was. */
  protected def failure(cause: Throwable): RenderFailure

  private var runNanos = 0L

  /** How long the last run took: from when its thread began until it found no more to do. */
  def seconds: Double = runNanos * 1e-9

  final def run(): Unit =
    val started = System.nanoTime
    try
      var step = board.takeStep()
      while step >= 0 do
        val wave = (step / schedule.pieces).toInt
        val piece = (step % schedule.pieces).toInt
        if board.awaitTurn(piece, wave) && work(piece, wave) then board.finish(piece, wave)
        step = board.takeStep()
      runNanos = System.nanoTime - started
    catch case e: Throwable => throw failure(e)

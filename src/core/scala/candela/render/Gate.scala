package candela.render

/** Holds all workers of a rendering, while its state is read. */
private[render] final class Gate:
  @volatile private var isClosed = false
  private var working = 0
  private var waiting = 0

  /** Announces workers, each of which passes through the gate until it leaves. */
  def expect(workers: Int): Unit = synchronized:
    working += workers

  private def isStill: Boolean = synchronized(waiting >= working)

  def exit(): Unit = synchronized:
    working -= 1
    notifyAll()

  /** Waits while the gate is closed. */
  def pass(): Unit = if isClosed then waitUntilOpen()

  private def waitUntilOpen(): Unit = synchronized:
    waiting += 1
    notifyAll()
    while isClosed do wait()
    waiting -= 1

  /** Runs `body` when all workers wait or have left, and lets them go on.
    *
    * @param goesOn asked about ten times a second until they do; if not, `body` is left out
    */
  def closed(body: => Unit)(goesOn: => Boolean): Unit =
    isClosed = true
    try
      while !isStill && goesOn do synchronized(if waiting < working then wait(Gate.Tick))
      if isStill then body
    finally
      synchronized:
        isClosed = false
        notifyAll()

private object Gate:
  /** In milliseconds. */
  val Tick = 100L

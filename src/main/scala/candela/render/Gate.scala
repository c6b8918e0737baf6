package candela.render

/** Holds all workers of a rendering, while its state is read. */
private[render] final class Gate:
  @volatile private var isClosed = false
  private var working = 0
  private var waiting = 0

  /** Announces workers, each of which passes through the gate until it leaves. */
  def expect(workers: Int): Unit = synchronized:
    working += workers

  def leave(): Unit = synchronized:
    working -= 1
    notifyAll()

  /** Waits while the gate is closed. */
  def pass(): Unit = if isClosed then waitUntilOpen()

  private def waitUntilOpen(): Unit = synchronized:
    waiting += 1
    notifyAll()
    while isClosed do wait()
    waiting -= 1

  /** Runs `body` when all workers wait or have left, and lets them go on. */
  def closed[A](body: => A): A =
    synchronized:
      isClosed = true
      while waiting < working do wait()
    try body
    finally
      synchronized:
        isClosed = false
        notifyAll()

package candela.watch

import java.io.BufferedInputStream
import java.net.{InetAddress, Socket}

/** What a connection is doing. */
private enum Phase:
  /** Answered, and told that nothing follows: waits for the client's end. */
  case Closing

  /** Between two requests, or before the first. */
  case Idle

  /** A request has begun to arrive. */
  case Receiving

  case Sending, Answering

/** A client's connection. One thread serves it; others look, and close it. */
private final class Connection(socket: Socket) extends AutoCloseable:
  import Connection.*

  private lazy val input = BufferedInputStream(socket.getInputStream, Request.MaxBytes)
  @volatile private var activity = Activity(Phase.Idle)
  @volatile private var answers = 0
  @volatile private var content = Array.emptyByteArray

  def address: InetAddress = socket.getInetAddress

  /** The body that is being sent. */
  def body: Array[Byte] = content

  def isBusy: Boolean = activity.phase == Phase.Answering || activity.phase == Phase.Sending

  /** Connections of low standing are closed first if there are too many: clients that keep the
    * server waiting, then those that have had few answers, the oldest of equals.
    */
  def standing: (Int, Int, Long) =
    val Activity(phase, start) = activity
    val rank = phase match
      case Phase.Closing => 0
      case Phase.Receiving | Phase.Sending if seconds(start) > SlowSeconds => 0
      case Phase.Answering => 2
      case _ => 1
    (rank, answers, start)

  /** Whether the client has kept the server waiting for so long. */
  def isLate(timeoutSeconds: Double): Boolean =
    val Activity(phase, start) = activity
    phase != Phase.Answering && seconds(start) > timeoutSeconds

  /** The next request's line and headers, as far as they fit; None: the client has ended. */
  def receive(): Option[String] =
    socket.setTcpNoDelay(true)
    val text = StringBuilder()
    var byte = input.read()
    activity = Activity(Phase.Receiving)
    while byte >= 0 && text.append(byte.toChar).length < Request.MaxBytes &&
      !text.endsWith("\r\n\r\n")
    do byte = input.read()
    activity = Activity(Phase.Answering)
    Option.when(byte >= 0)(text.toString)

  /** @param isGranted whether the client has asked for something that there is */
  def send(head: Array[Byte], body: Array[Byte], isGranted: Boolean): Unit =
    content = body
    activity = Activity(Phase.Sending)
    socket.getOutputStream.write(head)
    for start <- body.indices by PieceBytes do
      activity = Activity(Phase.Sending)
      socket.getOutputStream.write(body, start, Math.min(PieceBytes, body.length - start))
    content = Array.emptyByteArray
    if isGranted then answers += 1
    activity = Activity(Phase.Idle)

  /** Waits for the client's end: closed at once, what the client still sends would destroy the
    * answer on its way.
    */
  def awaitEnd(): Unit =
    activity = Activity(Phase.Closing)
    socket.shutdownOutput()
    while input.read() >= 0 do ()

  /** Ends what its thread waits for. */
  def close(): Unit = socket.close()

private object Connection:
  private final case class Activity(phase: Phase, start: Long = System.nanoTime)

  private def seconds(start: Long): Double = (System.nanoTime - start) * 1e-9

  /** Requests arrive, and pieces of answers leave, within this time, but for very slow clients. */
  private val SlowSeconds = 1.0

  /** Sent at once. */
  private val PieceBytes = 65536

package candela.watch

import java.net.InetAddress
import java.nio.ByteBuffer
import java.nio.channels.{SelectionKey, SocketChannel}

/** What a connection is doing, in the order in which connections are given up if there are too
  * many.
  *
  * @param seconds that it may take
  */
private enum Phase(val seconds: Double):
  /** Answered, and told that nothing follows: waits for the client's end. */
  case Ending extends Phase(1)

  /** Between two requests, or before the first. Pages ask every four seconds. */
  case Idle extends Phase(15)

  /** Receives a request. */
  case Reading extends Phase(5)

  /** Sends an answer; longer answers have more time. */
  case Writing extends Phase(10)

  /** A thread works on the answer. */
  case Answering extends Phase(Double.PositiveInfinity)

/** A client's connection. Only the server's loop uses it.
  *
  * @param client address
  */
private final class Connection(val channel: SocketChannel, val client: InetAddress):
  import Connection.*

  private val received = ByteBuffer.allocate(Request.MostBytes)
  private var key = Option.empty[SelectionKey]
  private var head, body = Array.emptyByteArray
  private var sent = 0L
  private var since = System.nanoTime
  private var current = Phase.Idle

  /** Whether it goes on after the answer. */
  private var keepsOpen = true

  def phase: Phase = current

  /** Begin of the phase, in nanoseconds. */
  def begin: Long = since

  /** The answer's bytes that are being sent. */
  def sending: Array[Byte] = body

  def register(key: SelectionKey): Unit = this.key = Some(key)

  def enter(phase: Phase): Unit =
    current = phase
    since = System.nanoTime
    val interest = phase match
      case Phase.Answering => 0
      case Phase.Writing => SelectionKey.OP_WRITE
      case _ => SelectionKey.OP_READ
    key.foreach(_.interestOps(interest))

  /** Whether the phase lasts too long. */
  def isLate(now: Long, patience: Double): Boolean =
    (now - since) * 1e-9 > patience * (phase.seconds + body.length / SlowestRate)

  /** Receives what there is; false: the client has ended. */
  def read(): Boolean =
    if phase == Phase.Ending then received.clear(): Unit
    channel.read(received) >= 0

  /** Takes the next request out of what was received, if it is whole. */
  def next(): Option[Either[Answer, Request]] =
    val count = received.position
    Request.end(received.array, count) match
      case -1 if !received.hasRemaining => Some(Left(TooLong))
      case -1 =>
        // Its time begins with the first byte, and further ones don't prolong it.
        if count > 0 && phase == Phase.Idle then enter(Phase.Reading)
        None
      case end =>
        val text = String(received.array, 0, end, "ISO-8859-1")
        received.flip().position(end)
        received.compact()
        Some(Request.parse(text))

  /** Begins to send an answer. */
  def send(head: Array[Byte], body: Array[Byte], keepsOpen: Boolean): Unit =
    this.head = head
    this.body = body
    this.keepsOpen = keepsOpen
    sent = 0
    enter(Phase.Writing)

  /** Sends what the client takes, some of it; true: all is sent.
    *
    * @param scratch direct memory
    */
  def write(scratch: ByteBuffer): Boolean =
    val all = head.length.toLong + body.length
    var turns = MostWrites
    while turns > 0 && sent < all do
      scratch.clear()
      if sent < head.length then
        val _ = scratch.put(head, sent.toInt, head.length - sent.toInt)
      val from = Math.max(0L, sent - head.length).toInt
      scratch.put(body, from, Math.min(scratch.remaining, body.length - from))
      scratch.flip()
      val count = channel.write(scratch)
      sent += count
      turns = if scratch.hasRemaining then 0 else turns - 1
    if sent == all then answered()
    sent == all

  private def answered(): Unit =
    head = Array.emptyByteArray
    body = Array.emptyByteArray
    if keepsOpen then enter(Phase.Idle)
    else
      channel.shutdownOutput()
      // Closed at once, what the client still sends would destroy the answer on its way.
      enter(Phase.Ending)

private object Connection:
  private val TooLong = Answer.text("the request is too long", 431)

  /** Bytes per second of the slowest clients that are served. */
  private val SlowestRate = 65536.0

  /** Pieces sent before others have their turn. */
  private val MostWrites = 16

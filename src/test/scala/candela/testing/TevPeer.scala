package candela.testing

import java.io.{DataInputStream, IOException}
import java.net.{InetAddress, ServerSocket}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.concurrent.LinkedBlockingQueue

/** What tev's protocol can say, as far as renderers use it. */
enum TevMessage:
  case Create(name: String, width: Int, height: Int, channels: Vector[String])
  case Update(name: String, channel: String, x: Int, y: Int, w: Int, h: Int, values: Vector[Float])

  /** The sender has closed the connection. */
  case End

/** A viewer that records what it is told. */
final class TevPeer extends AutoCloseable:
  private val server = ServerSocket(0, 1, InetAddress.getLoopbackAddress)
  val messages: LinkedBlockingQueue[TevMessage] = LinkedBlockingQueue()

  val port: Int = server.getLocalPort

  def close(): Unit = server.close()

  /** Accepts a connection and records at most `most` of its messages, then closes it. */
  def record(most: Int = Int.MaxValue): Thread =
    val thread = Thread: () =>
      val socket = server.accept()
      try
        val in = DataInputStream(socket.getInputStream)
        var count = 0
        while count < most do
          messages.put(TevPeer.read(in))
          count += 1
      catch case _: IOException => messages.put(TevMessage.End)
      finally socket.close()
    thread.setDaemon(true)
    thread.start()
    thread

  /** Accepts a connection and reads nothing. */
  def ignore(): Unit =
    val thread = Thread: () =>
      val _ = server.accept()
    thread.setDaemon(true)
    thread.start()

object TevPeer:
  def read(in: DataInputStream): TevMessage =
    val length = Integer.reverseBytes(in.readInt())
    val bytes = new Array[Byte](length - 4)
    in.readFully(bytes)
    val packet = ByteBuffer.wrap(bytes).order(ByteOrder.LITTLE_ENDIAN)
    def text(): String =
      val name = Iterator.continually(packet.get()).takeWhile(_ != 0).toArray
      String(name, "UTF-8")
    val operation = packet.get()
    val _ = packet.get() // whether to show it
    val name = text()
    val message = operation match
      case 4 =>
        val (width, height, count) = (packet.getInt(), packet.getInt(), packet.getInt())
        TevMessage.Create(name, width, height, Vector.fill(count)(text()))
      case 6 =>
        require(packet.getInt() == 1, "one channel a packet")
        val channel = text()
        val Vector(x, y, w, h) = Vector.fill(4)(packet.getInt()): @unchecked
        require(packet.getLong() == 0 && packet.getLong() == 1, "offset and stride")
        TevMessage.Update(name, channel, x, y, w, h, Vector.fill(w * h)(packet.getFloat()))
      case other => throw IllegalStateException(s"operation $other")
    require(!packet.hasRemaining, s"${packet.remaining} bytes too many")
    message

  /** The image that a viewer shows after these messages: channels interleaved. */
  def shown(messages: Seq[TevMessage]): Vector[Float] =
    val TevMessage.Create(_, width, height, channels) = messages.head: @unchecked
    val data = new Array[Float](width * height * channels.size)
    for case TevMessage.Update(_, channel, x, y, w, h, values) <- messages.tail do
      for row <- 0 until h; column <- 0 until w do
        val pixel = (y + row) * width + x + column
        data(pixel * channels.size + channels.indexOf(channel)) = values(row * w + column)
    data.toVector

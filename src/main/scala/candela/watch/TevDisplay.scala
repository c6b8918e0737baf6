package candela.watch

import candela.base.loop
import candela.image.Image
import candela.render.Background

import java.io.{BufferedOutputStream, IOException, OutputStream}
import java.net.{InetSocketAddress, Socket}

/** Shows a rendering in tev, by a thread of its own: sends the tiles that have changed since the
  * last snapshot. Goes on if the viewer is absent or goes away, and begins anew when it is back.
  *
  * @param name   of the image in the viewer
  * @param absent called once, if the viewer can't be reached at first
  */
final class TevDisplay(
    host: String,
    port: Int,
    name: String,
    observer: Observer,
    absent: IOException => Unit
) extends AutoCloseable:
  import TevDisplay.*

  @volatile private var connection: Option[TevLink] = None
  @volatile private var isClosed = false
  @volatile private var sentVersion = 0
  private var attempts = 0

  private val repeated = Background.repeat("display", TickMillis)(() => step())

  def isConnected: Boolean = connection.isDefined

  /** Waits until the viewer has the last image, but not for one that doesn't take it. */
  def await(): Unit =
    val version = observer.snapshot.fold(0)(_.version)
    val start = System.nanoTime
    // The viewer may have been started a moment ago.
    def hopes = isConnected || System.nanoTime - start < RetryTicks * TickMillis * 1_000_000
    while sentVersion < version && hopes && System.nanoTime - start < LiveView.LastImageTimeoutNanos
    do
      Thread.sleep(TickMillis / 5)

  def close(): Unit =
    isClosed = true
    connection.foreach(_.close()) // which ends a blocked write
    repeated.close()
    connection.foreach(_.close())

  private def step(): Unit =
    try
      if connection.isEmpty && !isClosed && attempts % RetryTicks == 0 then connect()
      for to <- connection; snapshot <- observer.snapshot if snapshot.version != sentVersion do
        to.send(snapshot.image)
        sentVersion = snapshot.version
    catch
      case e: IOException =>
        if attempts == 0 && connection.isEmpty && !isClosed then absent(e)
        connection.foreach(_.close())
        connection = None
        sentVersion = 0
    attempts += 1

  private def connect(): Unit =
    val socket = Socket()
    try
      socket.connect(InetSocketAddress(host, port), ConnectMillis)
      connection = Some(TevLink(socket, name))
    catch
      case e: IOException =>
        socket.close()
        throw e

object TevDisplay:
  /** tev's own default. */
  val DefaultPort = 14158

  /** Milliseconds between two looks at the snapshots. */
  private val TickMillis = 100L

  /** Looks from one try to connect to the next. */
  private val RetryTicks = 10

  private val ConnectMillis = 1000

  /** Edge of the updated tiles, in pixels, as in pbrt-v4. */
  private val TileEdge = 128

  /** A viewer, and what it shows. */
  private final class TevLink(socket: Socket, name: String):
    private val stream: OutputStream = BufferedOutputStream(socket.getOutputStream, 1 << 16)
    private var displayed: Option[Image] = None

    def close(): Unit = socket.close()

    def send(image: Image): Unit =
      val previous = displayed.getOrElse:
        stream.write(TevPacket.create(name, image.width, image.height, image.channelNames))
        Image(image.width, image.height, image.channelNames, new Array[Float](image.data.length))
      for
        y <- 0 until image.height by TileEdge
        x <- 0 until image.width by TileEdge
        channel <- 0 until image.channels
      do sendTile(previous, image, x, y, channel)
      stream.flush()
      displayed = Some(image)

    private def sendTile(previous: Image, image: Image, x: Int, y: Int, channel: Int): Unit =
      val width = Math.min(TileEdge, image.width - x)
      val height = Math.min(TileEdge, image.height - y)
      val values = new Array[Float](width * height)
      var isChanged = false
      loop(height): row =>
        loop(width): column =>
          val value = image(x + column, y + row, channel)
          values(row * width + column) = value
          if value != previous(x + column, y + row, channel) then isChanged = true
      if isChanged then
        stream.write(TevPacket.update(name, image.channelNames(channel), x, y, width, values))

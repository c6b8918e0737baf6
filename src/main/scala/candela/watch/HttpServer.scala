package candela.watch

import candela.render.Background

import java.io.IOException
import java.net.{InetAddress, ServerSocket}
import java.util.concurrent.ConcurrentHashMap

import scala.jdk.CollectionConverters.*
import scala.util.control.NonFatal

/** A small HTTP server that slow or many clients don't block: every connection has a
  * thread, all waits have an end, and new connections replace others if there are too many.
  *
  * @param policy         value of `Content-Security-Policy`
  * @param timeoutSeconds that a client may be idle, send a request, and read 64 KiB of an answer
  */
private[watch] final class HttpServer(
    address: InetAddress,
    requestedPort: Int,
    policy: String,
    answer: Request => Answer,
    timeoutSeconds: Double = 10
) extends AutoCloseable:
  import HttpServer.*

  private val listener = ServerSocket(requestedPort, MaxWaiting, address)
  private val threads = Background.pool("viewers", MaxConnections)
  private val connections = ConcurrentHashMap.newKeySet[Connection]()
  private var loops = Vector.empty[Background.Repeated]

  val port: Int = listener.getLocalPort

  def start(): Unit =
    loops = Vector(
      Background.repeat("page", 0)(() => accept()),
      Background.repeat("page-times", ClockMillis): () =>
        connections.asScala.filter(_.isLate(timeoutSeconds)).foreach(drop)
    )

  /** Closes all connections, after the answers that are under way. */
  def close(): Unit =
    val deadline = System.nanoTime + CloseNanos
    while connections.asScala.exists(_.isBusy) && System.nanoTime < deadline do Thread.sleep(5)
    listener.close()
    loops.foreach(_.close())
    connections.asScala.foreach(drop)
    threads.shutdownNow(): Unit

  private def accept(): Unit =
    try
      val connection = Connection(listener.accept())
      makeRoom(connection.address)
      connections.add(connection)
      threads.execute(() => serve(connection))
    catch
      case _: IOException if !listener.isClosed =>
        // Without file descriptors, the system offers the same connection again and again.
        dropLowest()
        Thread.sleep(ClockMillis)
      case _: IOException => ()

  private def makeRoom(client: InetAddress): Unit =
    val neighbours = connections.asScala.filter(_.address == client)
    if neighbours.size >= MaxPerAddress then drop(neighbours.minBy(_.standing))
    else if connections.size >= MaxConnections then dropLowest()

  private def dropLowest(): Unit = connections.asScala.minByOption(_.standing).foreach(drop)

  private def drop(connection: Connection): Unit =
    if connections.remove(connection) then connection.close()

  private def serve(connection: Connection): Unit =
    try while connection.receive().exists(exchange(connection, _)) do ()
    catch case NonFatal(_) => () // viewers may go at any time
    finally drop(connection)

  /** Answers a request; whether others may follow.
    *
    * @param head request line and headers
    */
  private def exchange(connection: Connection, head: String): Boolean =
    val request = Request.parse(head)
    val keepsOpen = request.exists(_.keepsOpen)
    val reply: Answer =
      try request.fold(Answer.text("bad request", 400))(answer)
      catch case NonFatal(e) => Answer.text(s"error: ${e.getMessage}", 500)
    limitMemory(reply.body)
    val hasBody = !request.exists(_.method == "HEAD")
    connection.send(
      reply.head(policy, keepsOpen),
      if hasBody then reply.body else Array.emptyByteArray,
      isGranted = reply.code == 200
    )
    if !keepsOpen then connection.awaitEnd()
    keepsOpen

  /** Slow clients keep what they read: images that nobody else needs any more. */
  private def limitMemory(body: Array[Byte]): Unit = synchronized:
    val senders = connections.asScala.filter(_.body.nonEmpty).map(c => c.standing -> c).toVector
      .sortBy(_._1).map(_._2)
    def bytes(among: Vector[Connection]) =
      (body +: among.map(_.body)).distinct.map(_.length.toLong).sum
    for rest <- senders.tails.find(rest => rest.isEmpty || bytes(rest) <= MaxSentBytes) do
      senders.dropRight(rest.size).foreach(drop)

private object HttpServer:
  /** Connections at the same time; a browser has up to six. */
  val MaxConnections = 64

  /** Connections that the system keeps until they are accepted: others try again after a second. */
  private val MaxWaiting = 1024

  /** Of one address, which may be that of a tunnel for several viewers. */
  val MaxPerAddress: Int = MaxConnections / 2

  /** Of different answers that are being sent. */
  private val MaxSentBytes = 256L << 20

  private val ClockMillis = 100L

  /** At its end, the server waits this long for clients that don't read. */
  private val CloseNanos = 1_000_000_000L

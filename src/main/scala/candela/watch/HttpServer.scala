package candela.watch

import candela.render.Background

import java.io.IOException
import java.net.{InetSocketAddress, StandardSocketOptions}
import java.nio.ByteBuffer
import java.nio.channels.{SelectionKey, Selector, ServerSocketChannel}
import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.{ConcurrentLinkedQueue, ExecutorService}

import scala.collection.mutable
import scala.jdk.CollectionConverters.*
import scala.util.control.NonFatal

/** A small HTTP server that slow or many clients don't block. One thread serves all connections and
  * waits for none; `threads` work on answers only. Every phase of a connection has its time. If
  * there are too many, those give way to new ones that do least and have done it longest.
  *
  * @param policy value of `Content-Security-Policy`
  * @param answer called by `threads`
  * @param patience factor of all times that clients have
  */
private[watch] final class HttpServer(
    address: InetSocketAddress,
    threads: ExecutorService,
    policy: String,
    answer: Request => Answer,
    patience: Double = 1
) extends AutoCloseable:
  import HttpServer.*

  private val listener = ServerSocketChannel.open()
  private val selector =
    try
      listener.bind(address)
      listener.configureBlocking(false)
      Selector.open()
    catch
      case e: IOException =>
        listener.close()
        throw e

  private val connections = mutable.LinkedHashSet.empty[Connection]
  private val scratch = ByteBuffer.allocateDirect(ScratchBytes)
  private val answers = ConcurrentLinkedQueue[(Connection, Request, Answer)]()
  private val underWay = AtomicInteger()
  @volatile private var isClosing = false
  private var loop = Option.empty[Background.Repeated]

  val port: Int = listener.socket.getLocalPort

  def start(): Unit =
    listener.register(selector, SelectionKey.OP_ACCEPT)
    loop = Some(Background.repeat("page", 0)(() => turn()))

  /** Closes all connections, after the answers that are under way. */
  def close(): Unit =
    val begin = System.nanoTime
    while underWay.get > 0 && System.nanoTime - begin < CloseTimeoutNanos do Thread.sleep(5)
    isClosing = true
    selector.wakeup()
    loop.foreach(_.close())
    connections.toVector.foreach(drop)
    listener.close()
    selector.close()

  private def turn(): Unit =
    if !isClosing then
      val _ = selector.select(if connections.isEmpty then LongestPause else ShortPause)
      val keys = selector.selectedKeys
      val ready = keys.asScala.toVector
      keys.clear()
      for key <- ready do
        key.attachment match
          case c: Connection => guarded(c)(serve(c))
          case _ => accept()
      Iterator.continually(answers.poll()).takeWhile(_ != null).foreach: (c, request, answer) =>
        if connections(c) then
          guarded(c)(send(c, answer, request.isHead, request.keepsOpen))
      val now = System.nanoTime
      connections.filter(_.isLate(now, patience)).foreach(drop)

  /** A connection that fails ends; it is no error, as viewers may go at any time. */
  private def guarded(c: Connection)(work: => Unit): Unit =
    try work
    catch case NonFatal(_) => drop(c)

  private def accept(): Unit =
    try
      // A few at a time: between them, what they ask for is received.
      Iterator.continually(listener.accept()).take(MostAccepted).takeWhile(_ != null)
        .foreach: channel =>
          channel.configureBlocking(false)
          channel.setOption(StandardSocketOptions.TCP_NODELAY, true)
          val c = Connection(channel, channel.socket.getInetAddress)
          c.register(channel.register(selector, SelectionKey.OP_READ, c))
          makeRoom(c)
          connections += c
    catch
      case _: IOException =>
        // Without file descriptors, the system offers the same connection again and again.
        connections.minByOption(standing).foreach(drop)
        Thread.sleep(ShortPause)

  private def makeRoom(newcomer: Connection): Unit =
    val own = connections.filter(_.client == newcomer.client)
    if own.sizeIs >= MostOfClient then drop(own.minBy(standing))
    else if connections.sizeIs >= MaxConnections then drop(connections.minBy(standing))

  /** Connections of low standing give way first. */
  private def standing(c: Connection): (Int, Long) = (c.phase.ordinal, c.begin)

  private def drop(c: Connection): Unit =
    if connections.remove(c) then
      if c.phase == Phase.Writing || c.phase == Phase.Answering then
        val _ = underWay.decrementAndGet()
      try c.channel.close()
      catch case _: IOException => ()

  private def serve(c: Connection): Unit = c.phase match
    case Phase.Writing => write(c)
    case Phase.Answering => ()
    case Phase.Ending => if !c.read() then drop(c)
    case _ => if c.read() then proceed(c) else drop(c)

  /** Turns to the next request, if it is whole. */
  private def proceed(c: Connection): Unit =
    c.next().foreach: received =>
      underWay.incrementAndGet()
      c.enter(Phase.Answering)
      received match
        case Left(refusal) => send(c, refusal, isHead = false, keepsOpen = false)
        case Right(request) => threads.execute(() => work(c, request))

  private def work(c: Connection, request: Request): Unit =
    val found =
      try answer(request)
      catch case NonFatal(e) => Answer.text(s"error: ${e.getMessage}", 500)
    answers.add((c, request, found))
    val _ = selector.wakeup()

  private def send(c: Connection, answer: Answer, isHead: Boolean, keepsOpen: Boolean): Unit =
    val body = if isHead then Array.emptyByteArray else answer.body
    c.send(answer.head(policy, keepsOpen), body, keepsOpen)
    makeMemory(c)
    write(c)

  /** Slow clients keep what they read: pictures that nobody else needs any more. */
  private def makeMemory(c: Connection): Unit =
    val others = connections.toVector.filter(o => o.phase == Phase.Writing && o != c)
    def bytes(all: Vector[Connection]) =
      all.map(_.sending).distinct.map(_.length.toLong).sum
    val slowest = others.sortBy(_.begin).tails.map(_ :+ c)
    for kept <- slowest.find(all => all.sizeIs == 1 || bytes(all) <= MostBytes) do
      others.filterNot(kept.contains).foreach(drop)

  private def write(c: Connection): Unit =
    if c.write(scratch) then
      underWay.decrementAndGet()
      if c.phase == Phase.Idle then proceed(c)

private object HttpServer:
  /** Connections at the same time; a browser has up to six. */
  val MaxConnections = 64

  /** Of them of one address, which may be that of a tunnel for several viewers. */
  val MostOfClient = 32

  /** New ones at once. */
  private val MostAccepted = 8

  /** Of different answers that are being sent. */
  private val MostBytes = 256L << 20

  /** Sent at once. */
  private val ScratchBytes = 65536

  // In milliseconds
  private val ShortPause = 100L
  private val LongestPause = 10_000L

  /** At its end, the server waits this long for clients that don't read. */
  private val CloseTimeoutNanos = 1_000_000_000L

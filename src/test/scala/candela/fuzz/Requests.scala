package candela.fuzz

import java.net.Socket
import java.nio.file.Files

import scala.collection.mutable
import scala.util.Try

import candela.watch.FuzzedServer

/** Requests to the live page that are broken, cut, slow, or many; others are served meanwhile. */
final class Requests(place: Place) extends Attempts:
  import Requests.*
  import place.random

  private val server = new FuzzedServer()
  private val folder = Files.createDirectories(place.folder.resolve("requests"))
  private val mutator = Mutator(Corpus, random)

  /** Clients that have begun a request, and neither end it nor read. */
  private val slow = mutable.Queue.empty[Socket]

  override def close(): Unit =
    slow.foreach(_.close())
    server.close()

  private def pieces(bytes: Array[Byte]): Vector[Array[Byte]] =
    val size = if random.nextBoolean() then bytes.length.max(1) else 1 + random.nextInt(300)
    bytes.grouped(size).toVector

  def next(): Attempt =
    val bytes = if random.nextInt(4) == 0 then mutator.text() else mutator.bytes()
    val isSlow = random.nextInt(10) == 0
    val asks = random.nextInt(20) == 0
    val file = folder.resolve("request")
    val parts = pieces(bytes)
    def judge() =
      val wrong = if isSlow then held(bytes) else server.talk(parts)
      if wrong.nonEmpty then Files.write(file, bytes): Unit
      wrong.orElse(Option.when(asks && !server.serves)("another client is not served"))
    Attempt(s"${bytes.length} bytes", Vector(file), () => judge())

  private def held(bytes: Array[Byte]): Option[String] =
    val socket = server.connected()
    slow += socket
    if slow.size > MaxSlowSockets then slow.dequeue().close()
    // It may have given way to others
    val _ = Try(socket.getOutputStream.write(bytes))
    None

private object Requests:
  private val MaxSlowSockets = 60

  private val Corpus: Vector[Array[Byte]] = Vector(
    "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "GET /large HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n",
    "HEAD /a HTTP/1.1\r\nHost: a\r\nOrigin: http://a\r\n\r\nGET /b HTTP/1.1\r\nHost: a\r\n\r\n",
    "GET http://b:80/2?y=%20&z=%c3%a4 HTTP/1.1\r\nHost: a\r\n\r\n",
    "POST /stop HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n0123456789",
    "POST /stop HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
    "POST /camera?move=orbit&x=0.1&y=-0.05&begin=1 HTTP/1.1\r\nHost: a\r\n\r\n",
    "POST /camera?move=dolly&by=2 HTTP/1.1\r\nHost: a\r\n\r\n",
    "POST /camera?move=focus&x=.5&y=1e0 HTTP/1.1\r\nHost: a\r\n\r\n",
    "POST /camera?move=fov&to=41.5 HTTP/1.1\r\nHost: a\r\n\r\n",
    "GET /x HTTP/1.0\r\n\r\n",
    "GET /x HTTP/2.0\r\nHost: a\r\n\r\n",
    "OPTIONS * HTTP/1.1\r\nHost: a\r\n\r\n",
    "CONNECT a:1 HTTP/1.1\r\nHost: a:1\r\n\r\n",
    s"GET /${"x" * 8000} HTTP/1.1\r\nHost: a\r\n\r\n",
    s"GET / HTTP/1.1\r\nHost: a\r\n${"X-Many: 1\r\n" * 500}\r\n",
    "\u0016\u0003\u0001\u0002\u0000\u0001\u0000\u0001\u00fc\u0003\u0003",
    "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    "GET / HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n"
  ).map(_.getBytes("ISO-8859-1"))

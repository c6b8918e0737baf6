package candela.watch

import candela.testing.Eventually.eventually

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.io.{ByteArrayOutputStream, InputStream}
import java.net.{InetAddress, InetSocketAddress, Socket}

import scala.util.Try

/** Real sockets: clients that are slow, many, or wrong, and one that is none of these. */
class HttpServerSuite extends AnyFunSuite:
  import HttpServerSuite.*

  private val large = Array.tabulate(16 << 20)(i => (i * 7).toByte)

  private def answer(request: Request): Answer = request.path match
    case "/large" => Answer("application/octet-stream", large)
    case "/fails" => throw IllegalStateException("on purpose")
    case path => Answer.text(s"${request.method} $path ${request.query.toVector.sorted}")

  private def serving[A](timeoutSeconds: Double = 10)(test: Int => A): A =
    val server = HttpServer(here, 0, "default-src 'none'", answer, timeoutSeconds)
    server.start()
    try test(server.port)
    finally server.close()

  /** Many clients do something, then another one is served while they still may. */
  private def besides(count: Int)(first: Socket => Unit): Unit =
    serving(timeoutSeconds = 1000): port =>
      val crowd = Vector.newBuilder[Socket]
      try
        for _ <- 1 to count do
          val socket = connected(port)
          crowd += socket
          // It may have given way to others already.
          try first(socket)
          catch case _: java.io.IOException => ()
        for _ <- 1 to 5 do assert(asked(port, "GET", "/a?x=1").body == "GET /a Vector((x,1))")
      finally crowd.result().foreach(_.close())

  private def besidesSlowHeaders(count: Int): Unit =
    besides(count)(send(_, "GET / HTTP/1.1\r\nHost: a\r\nX-Slow: "))

  test("16 clients with slow headers keep no other one waiting"):
    besidesSlowHeaders(16)

  test("300 clients with slow headers keep no other one waiting", Slow):
    besidesSlowHeaders(300)

  test("clients that connect and say nothing keep no other one waiting", Slow):
    besides(300)(_ => ())

  test("clients with slow bodies keep no other one waiting, and are told that none is wanted"):
    besides(100): socket =>
      send(socket, "POST /stop HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000\r\n\r\nabc")
      assert(received(socket.getInputStream).code == 400): Unit

  test("clients that keep their connections keep no other one waiting", Slow):
    besides(300): socket =>
      send(socket, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
      assert(received(socket.getInputStream).code == 200): Unit

  test("clients that don't read what they ask for keep no other one waiting", Slow):
    besides(100)(send(_, "GET /large HTTP/1.1\r\nHost: a\r\n\r\n"))

  test("what a client asks for it gets, while others of its address take all connections"):
    serving(): port =>
      val crowd = Vector.fill(HttpServer.MaxPerAddress - 1)(connected(port))
      try
        crowd.foreach(send(_, "GET / HTTP/1.1\r\n"))
        assert(asked(port, "GET", "/large").bytes.sameElements(large))
      finally crowd.foreach(_.close())

  test("viewers that have had an answer keep their connections while others send half requests"):
    serving(): port =>
      val viewers = Vector.fill(8)(connected(port))
      def ask(): Unit =
        for viewer <- viewers do
          send(viewer, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
          assert(received(viewer.getInputStream).code == 200)
      try
        ask()
        val crowd = Vector.fill(2 * HttpServer.MaxConnections)(connected(port))
        try
          crowd.foreach(c => Try(send(c, "GET / HTTP/1.1\r\n")))
          // All of the crowd are accepted before this one
          assert(asked(port, "GET", "/b").code == 200)
          ask()
        finally crowd.foreach(_.close())
      finally viewers.foreach(_.close())

  private def others(kind: String)(first: Socket => Unit): Unit =
    test(s"a viewer keeps its connection while others $kind, again and again"):
      serving(): port =>
        val viewer = connected(port)
        def ask(): Unit =
          send(viewer, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
          assert(received(viewer.getInputStream).code == 200): Unit
        try
          for _ <- 1 to 3 do ask()
          for _ <- 1 to 4 do
            val crowd = Vector.fill(HttpServer.MaxConnections)(connected(port))
            try
              crowd.foreach(c => Try(first(c)))
              ask()
            finally crowd.foreach(_.close())
        finally viewer.close()

  others("ask once, and wait"): socket =>
    send(socket, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
    received(socket.getInputStream): Unit

  others("ask for much, and don't read it"): socket =>
    send(socket, "GET /large HTTP/1.1\r\nHost: a\r\n\r\n")

  others("ask once, and begin another request"): socket =>
    send(socket, "GET /a HTTP/1.1\r\nHost: a\r\n\r\nGET /b HTTP/1.1\r\n")
    received(socket.getInputStream): Unit

  test("requests that are still incomplete after a second give way first"):
    serving(): port =>
      val slow = connected(port)
      try
        send(slow, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
        assert(received(slow.getInputStream).code == 200)
        send(slow, "GET /slow HTTP/1.1\r\n")
        Thread.sleep(1100)
        val crowd = Vector.fill(HttpServer.MaxPerAddress)(connected(port))
        try
          assert(ends(slow))
          send(crowd.head, "GET /a HTTP/1.1\r\nHost: a\r\n\r\n")
          assert(received(crowd.head.getInputStream).code == 200)
        finally crowd.foreach(_.close())
      finally slow.close()

  test("one address can't take the connections of another", Slow):
    serving(): port =>
      val own = connected(port, "127.0.0.2")
      send(own, "GET /a HTTP/1.1\r\nHost: a\r\nX-Half: ")
      val crowd = Vector.fill(4 * HttpServer.MaxConnections)(connected(port))
      try
        assert(asked(port, "GET", "/b").code == 200)
        send(own, "1\r\n\r\n")
        assert(received(own.getInputStream).body == "GET /a Vector()")
      finally (own +: crowd).foreach(_.close())

  test("every wait has an end: slow headers, idle connections, clients that don't read", Slow):
    serving(timeoutSeconds = 0.2): port =>
      for words <- Vector("", "GET / HTTP/1.1\r\n") do
        val socket = connected(port)
        try
          send(socket, words)
          assert(ends(socket), words)
        finally socket.close()
      val reader = connected(port)
      try
        send(reader, "GET /large HTTP/1.1\r\nHost: a\r\n\r\n")
        eventually("end of the connection")(Try(send(reader, " ")).failed.toOption): Unit
      finally reader.close()

  test("every answer has a length, and forbids what others may do with it"):
    serving(): port =>
      val wrong = Vector(
        "GET / HTTP/1.1\r\nHost: a\r\n\r\n" -> 200,
        "GET /fails HTTP/1.1\r\nHost: a\r\n\r\n" -> 500,
        "GET /?x=%zz HTTP/1.1\r\nHost: a\r\n\r\n" -> 400,
        "GET / HTTP/1.1\r\n\r\n" -> 400,
        "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n" -> 400,
        "GET / HTTP/1.1\r\nHost: a\r\n folded\r\n\r\n" -> 400,
        "GET / HTTP/1.1\r\nHost : a\r\n\r\n" -> 400,
        "nonsense\r\n\r\n" -> 400,
        "\u0016\u0003\u0001\r\n\r\n" -> 400,
        "GET / HTTP/2.0\r\nHost: a\r\n\r\n" -> 400,
        "POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n" -> 400,
        s"GET /${"x" * 9000} HTTP/1.1\r\nHost: a\r\n\r\n" -> 400
      )
      for (words, code) <- wrong do
        val socket = connected(port)
        try
          send(socket, words)
          val got = received(socket.getInputStream)
          assert(got.code == code, words)
          assert(got.header("Content-Length").contains(got.bytes.length.toString), words)
          for (name, value) <- Guards do assert(got.header(name).contains(value), s"$words: $name")
        finally socket.close()

  test("HEAD has the headers of GET and no body, and the connection goes on"):
    serving(): port =>
      val socket = connected(port)
      try
        send(socket, "HEAD /large HTTP/1.1\r\nHost: a\r\n\r\nGET /a HTTP/1.1\r\nHost: a\r\n\r\n")
        val head = received(socket.getInputStream, hasBody = false)
        assert(head.code == 200 && head.header("Content-Length").contains(large.length.toString))
        assert(received(socket.getInputStream).body == "GET /a Vector()")
      finally socket.close()

  test("requests may follow each other at once, in pieces, and with a full address"):
    serving(): port =>
      val socket = connected(port)
      try
        val words = "\r\nGET /1 HTTP/1.1\r\nhost:a\r\n\r\n" +
          "GET http://b:80/2?y=%20 HTTP/1.1\r\n\r\n" +
          "GET /3 HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"
        for part <- words.grouped(7) do send(socket, part)
        val all = Vector.fill(3)(received(socket.getInputStream))
        assert(all.map(_.body) ==
          Vector("GET /1 Vector()", "GET /2 Vector((y, ))", "GET /3 Vector()"))
        assert(all.map(_.header("Connection")) ==
          Vector(Some("keep-alive"), Some("keep-alive"), Some("close")))
        assert(socket.getInputStream.read() == -1)
      finally socket.close()

object HttpServerSuite:
  private val here = InetAddress.getLoopbackAddress

  private val Guards = Vector(
    "Content-Security-Policy" -> "default-src 'none'",
    "X-Frame-Options" -> "DENY",
    "X-Content-Type-Options" -> "nosniff",
    "Referrer-Policy" -> "no-referrer"
  )

  private final case class Got(code: Int, headers: Map[String, String], bytes: Array[Byte]):
    def header(name: String): Option[String] = headers.get(name.toLowerCase)
    def body: String = String(bytes, "UTF-8")

  private def connected(port: Int, from: String = "127.0.0.1"): Socket =
    val socket = Socket()
    socket.bind(InetSocketAddress(from, 0))
    // Ends a test whose server does not answer; what it waits for takes its clients far longer
    socket.setSoTimeout(60_000)
    socket.connect(InetSocketAddress(here, port), 2000)
    socket

  private def send(socket: Socket, words: String): Unit =
    socket.getOutputStream.write(words.getBytes("ISO-8859-1"))

  private def asked(port: Int, method: String, path: String): Got =
    val socket = connected(port)
    try
      send(socket, s"$method $path HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n")
      received(socket.getInputStream)
    finally socket.close()

  /** Whether the server ends the connection. */
  private def ends(socket: Socket): Boolean =
    try socket.getInputStream.read() == -1
    catch
      case _: java.net.SocketTimeoutException => false
      case _: java.io.IOException => true

  /** An answer, as far as it comes. */
  private def received(in: InputStream, hasBody: Boolean = true): Got =
    val head = ByteArrayOutputStream()
    while !head.toString("ISO-8859-1").endsWith("\r\n\r\n") do
      val byte = in.read()
      if byte < 0 then throw java.io.EOFException(s"no answer but: $head")
      head.write(byte)
    val lines = head.toString("ISO-8859-1").split("\r\n").toVector
    val headers = lines.tail.map(_.split(": ", 2)).map(a => a(0).toLowerCase -> a(1)).toMap
    val length = if hasBody then headers("content-length").toInt else 0
    val bytes =
      try in.readNBytes(length)
      catch case _: java.net.SocketException => Array.emptyByteArray
    Got(lines.head.split(' ')(1).toInt, headers, bytes)

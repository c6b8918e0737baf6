package candela.watch

import candela.moving.CameraMoves

import java.net.{InetAddress, InetSocketAddress, Socket, SocketException, SocketTimeoutException}

import scala.util.Try

/** The live page's server, for the fuzzer: it answers what is no request, too. */
final class FuzzedServer extends AutoCloseable:
  private val here = InetAddress.getLoopbackAddress
  private val large = Array.tabulate(1 << 20)(_.toByte)

  private def answer(request: Request): Answer = request.path match
    case "/large" => Answer("application/octet-stream", large)
    // As the page of `candela move` parses them
    case "/camera" =>
      CameraMoves.parse(request.query).fold(Answer.text(_, 400), _ => Answer.text(""))
    case path => Answer.text(path)

  private val server =
    HttpServer(here, 0, "default-src 'none'", answer, timeoutSeconds = 2)
  server.start()

  def close(): Unit = server.close()

  def connected(): Socket =
    val socket = Socket()
    socket.setSoTimeout(5000)
    socket.connect(InetSocketAddress(here, server.port), 5000)
    socket

  /** Sends pieces, and then no more; what is wrong with the answers, if anything is. */
  def talk(pieces: Seq[Array[Byte]]): Option[String] =
    parsed(pieces.toArray.flatten).orElse:
      val socket = connected()
      try
        val out = socket.getOutputStream
        // The server may have ended already
        val _ = Try:
          pieces.foreach(out.write(_))
          socket.shutdownOutput()
        FuzzedServer.wrong(socket.getInputStream.readAllBytes())
      catch
        case _: SocketException => None
        case _: SocketTimeoutException => Some("the connection has no end")
      finally socket.close()

  /** Whether somebody else is served as usual, within some seconds on a busy machine. */
  def serves: Boolean = Try:
    val socket = connected()
    try
      socket.getOutputStream.write("GET /a HTTP/1.0\r\nConnection: close\r\n\r\n".getBytes)
      String(socket.getInputStream.readAllBytes()).endsWith("\r\n\r\n/a")
    finally socket.close()
  .getOrElse(false)

  /** The server drops a connection whose request is not understood because of a fault. */
  private def parsed(bytes: Array[Byte]): Option[String] =
    try
      val text = String(bytes, 0, bytes.length.min(Request.MaxBytes), "ISO-8859-1")
      val end = text.indexOf("\r\n\r\n")
      val _ = Request.parse(if end < 0 then text else text.take(end + 4))
      None
    catch case e: Throwable => Some(s"$e at ${e.getStackTrace.take(5).mkString(", ")}")

private object FuzzedServer:

  /** What is wrong with answers that follow each other; the last may be cut. */
  private def wrong(bytes: Array[Byte]): Option[String] =
    val text = String(bytes, "ISO-8859-1")
    var at = 0
    var found = Option.empty[String]
    while found.isEmpty && at < text.length do
      val end = text.indexOf("\r\n\r\n", at)
      val head = if end < 0 then text.substring(at) else text.substring(at, end)
      if !head.startsWith("HTTP/1.1 ") then found = Some(s"no answer: ${head.take(200)}")
      else if head.startsWith("HTTP/1.1 500") then
        found = Some(s"an error: ${text.slice(at, at + 900)}")
      else if end < 0 then at = text.length
      else
        val length = "(?m)^Content-Length: (\\d+)".r.findFirstMatchIn(head).map(_.group(1).toInt)
        length match
          // Of HEAD, nothing follows
          case Some(_) if text.startsWith("HTTP/1.1 ", end + 4) => at = end + 4
          case Some(n) => at = end + 4 + n
          case None => found = Some(s"no length: $head")
    found

package candela.watch

import java.net.URLDecoder
import java.nio.charset.StandardCharsets.UTF_8

import scala.util.Try

/** A request of a browser. None has a body: viewers only ask.
  *
  * @param path      as sent, from its slash
  * @param keepsOpen whether the client wants to ask more on the same connection
  */
private[watch] final case class Request(
    method: String,
    path: String,
    query: Map[String, String],
    host: Option[String],
    origin: Option[String],
    keepsOpen: Boolean
):
  def isHead: Boolean = method == "HEAD"

/** After RFC 9112, HTTP/1.1. */
private[watch] object Request:
  /** Bytes of request line and headers; browsers send some hundred. */
  val MostBytes = 8192

  /** Number of bytes of the first request among `count`, or −1 if its end is missing. */
  def end(bytes: Array[Byte], count: Int): Int =
    (3 until count).indexWhere(i =>
      bytes(i) == '\n' && bytes(i - 1) == '\r' && bytes(i - 2) == '\n' && bytes(i - 3) == '\r'
    ) match
      case -1 => -1
      case i => i + 4

  /** @param head all up to the empty line; Left: the answer to what is no request */
  def parse(head: String): Either[Answer, Request] =
    val lines = head.split("\r\n").toVector.dropWhile(_.isEmpty)
    val fields = lines.drop(1).map(field)
    def values(name: String) = fields.collect { case Some((`name`, value)) => value }
    def has(name: String, word: String) =
      values(name).exists(_.split(',').exists(_.trim.equalsIgnoreCase(word)))
    lines.headOption.map(_.split(" ", -1)) match
      case _ if fields.contains(None) || head.exists(c => c < ' ' && !"\r\n\t".contains(c)) => bad
      case Some(Array(_, _, s"HTTP/$version")) if version != "1.1" && version != "1.0" =>
        Left(Answer.text("only HTTP/1.1 is spoken here", 505))
      case Some(Array(method, target, s"HTTP/$version")) if method.nonEmpty =>
        // The authority of an absolute target counts instead of the header.
        val (hosts, local) = target match
          case s"http://$authority/$rest" => (Vector(authority), s"/$rest")
          case _ => (values("host"), target)
        val hasBody =
          values("content-length").exists(_ != "0") || values("transfer-encoding").nonEmpty
        if hosts.sizeIs > 1 || (hosts.isEmpty && version == "1.1") then bad
        else if hasBody then Left(Answer.text("no request has a body here", 413))
        else
          val (path, raw) = local.span(_ != '?')
          query(raw.drop(1)).fold(bad): pairs =>
            Right(Request(
              method,
              path,
              pairs,
              hosts.headOption,
              values("origin").headOption,
              version == "1.1" && !has("connection", "close")
            ))
      case _ => bad

  private def bad = Left(Answer.text("bad request", 400))

  private def field(line: String): Option[(String, String)] =
    line.split(":", 2) match
      case Array(name, value) if name.nonEmpty && !name.exists(_ <= ' ') =>
        Some((name.toLowerCase, value.trim))
      case _ => None

  private def query(raw: String): Option[Map[String, String]] = Try:
    raw.split('&').collect:
      case s"$key=$value" => key -> URLDecoder.decode(value, UTF_8)
    .toMap
  .toOption

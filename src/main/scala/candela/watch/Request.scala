package candela.watch

import java.net.URLDecoder
import java.nio.charset.StandardCharsets.UTF_8
import java.util.Locale

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
)

/** After RFC 9112, HTTP/1.1. */
private[watch] object Request:
  /** Bytes of request line and headers; browsers send some hundred. */
  val MaxBytes = 8192

  /** Method, authority if it is sent, path, query, and the minor version. */
  private val StartLine =
    raw"(\S+) (?:http://([^/?\s]+))?(/[^?\s]*)(?:\?(\S*))? HTTP/1\.([01])".r
  private val Field = raw"([!-9;-~]+):[ \t]*([^\x00-\x08\x0a-\x1f]*)".r

  /** @param head all up to the empty line, or as far as it fits; None: it is no request */
  def parse(head: String): Option[Request] =
    val lines = head.split("\r\n").toVector.dropWhile(_.isEmpty)
    val fields = lines.drop(1).collect { case Field(name, value) =>
      name.toLowerCase(Locale.ROOT) -> value.trim
    }
    def values(name: String) = fields.collect { case (`name`, value) => value }
    def hasBody = values("content-length").exists(_ != "0") || values("transfer-encoding").nonEmpty
    val isWhole = head.endsWith("\r\n\r\n") && fields.size == lines.size - 1
    lines.headOption match
      case Some(StartLine(method, authority, path, query, minor)) if isWhole && !hasBody =>
        // The authority of an absolute target counts instead of the header.
        val hosts = Option(authority).fold(values("host"))(Vector(_))
        val isModern = minor == "1"
        val closes =
          values("connection").exists(_.split(',').exists(_.trim.equalsIgnoreCase("close")))
        for
          pairs <- parameters(Option(query).getOrElse(""))
          if hosts.size == 1 || (hosts.isEmpty && !isModern)
        yield Request(
          method,
          path,
          pairs,
          hosts.headOption,
          values("origin").headOption,
          isModern && !closes
        )
      case _ => None

  private def parameters(query: String): Option[Map[String, String]] = Try:
    query.split('&').collect:
      case s"$key=$value" => key -> URLDecoder.decode(value, UTF_8)
    .toMap
  .toOption

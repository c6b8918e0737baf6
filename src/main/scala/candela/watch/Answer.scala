package candela.watch

import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_8}
import java.security.MessageDigest
import java.time.format.DateTimeFormatter.RFC_1123_DATE_TIME
import java.time.{ZoneOffset, ZonedDateTime}
import java.util.Base64

/** An answer to a request.
  *
  * @param kind its content type
  */
private[watch] final case class Answer(
    kind: String,
    body: Array[Byte],
    headers: Vector[(String, String)] = Vector.empty,
    code: Int = 200
):
  /** Status line and headers.
    *
    * @param policy what the page may load and run
    */
  def head(policy: String, keepsOpen: Boolean): Array[Byte] =
    val fields = Vector(
      "Date" -> RFC_1123_DATE_TIME.format(ZonedDateTime.now(ZoneOffset.UTC)),
      "Content-Type" -> s"$kind; charset=utf-8",
      "Content-Length" -> body.length.toString,
      "Cache-Control" -> "no-store",
      "Connection" -> (if keepsOpen then "keep-alive" else "close"),
      "Content-Security-Policy" -> policy
    ) ++ Answer.Guards ++ headers
    // The reason phrase may be empty
    val lines = s"HTTP/1.1 $code " +: fields.map((name, value) => s"$name: $value")
    lines.mkString("", "\r\n", "\r\n\r\n").getBytes(ISO_8859_1)

private[watch] object Answer:
  def text(words: String, code: Int = 200): Answer =
    Answer("text/plain", words.getBytes(UTF_8), code = code)

  val NotFound: Answer = text("not found", 404)

  /** @param methods those that are allowed */
  def notAllowed(methods: String): Answer =
    text("method not allowed", 405).copy(headers = Vector("Allow" -> methods))

  /** Against pages of others that show this one, read it, or learn its address. */
  private val Guards = Vector(
    "X-Frame-Options" -> "DENY",
    "X-Content-Type-Options" -> "nosniff",
    "Referrer-Policy" -> "no-referrer",
    "Cross-Origin-Opener-Policy" -> "same-origin",
    "Cross-Origin-Resource-Policy" -> "same-origin"
  )

/** The value of `Content-Security-Policy`. */
private[watch] object PagePolicy:

  /** Lets `page` run its own script and style, and ask its own server; nothing else. */
  def allowing(page: String): String =
    def hashes(element: String) =
      val sources = s"(?s)<$element>(.*?)</$element>".r.findAllMatchIn(page).map(_.group(1))
      val sums = sources.map(s => MessageDigest.getInstance("SHA-256").digest(s.getBytes(UTF_8)))
      sums.map(sum => s"'sha256-${Base64.getEncoder.encodeToString(sum)}'").mkString(" ")
    Vector(
      "default-src 'none'",
      s"script-src ${hashes("script")}",
      s"style-src ${hashes("style")}",
      "connect-src 'self'",
      "img-src data:",
      "base-uri 'none'",
      "form-action 'none'",
      "frame-ancestors 'none'"
    ).mkString("; ")

package candela.testing

import java.net.URI
import java.net.http.{HttpClient, HttpRequest, HttpResponse}

/** Requests to a server of this machine. */
object WebClient:
  final case class Answer(code: Int, body: Array[Byte], header: String => Option[String]):
    def text: String = String(body, "UTF-8")

  private val client = HttpClient.newHttpClient

  def get(address: String, headers: (String, String)*): Answer = ask(address, headers)(_.GET)

  def post(address: String, headers: (String, String)*): Answer =
    ask(address, headers)(_.POST(HttpRequest.BodyPublishers.noBody))

  def ask(method: String, address: String): Answer =
    ask(address, Seq.empty)(_.method(method, HttpRequest.BodyPublishers.noBody))

  private def ask(address: String, headers: Seq[(String, String)])(
      method: HttpRequest.Builder => HttpRequest.Builder
  ): Answer =
    val request = method(HttpRequest.newBuilder(URI(address)))
    for (key, value) <- headers do request.header(key, value)
    val answer = client.send(request.build, HttpResponse.BodyHandlers.ofByteArray)
    Answer(
      answer.statusCode,
      answer.body,
      key => Option(answer.headers.firstValue(key).orElse(null))
    )

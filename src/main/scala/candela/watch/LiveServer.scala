package candela.watch

import candela.report.{LiveData, LiveState}

import com.sun.net.httpserver.{HttpExchange, HttpServer}

import java.net.{InetAddress, InetSocketAddress, URLDecoder}
import java.nio.charset.StandardCharsets.UTF_8
import java.util.concurrent.ExecutorService
import java.util.concurrent.atomic.AtomicInteger

import scala.util.Try

/** Serves the live page.
  *
  * @param page     HTML
  * @param observer of the rendering
  * @param state    how far it is
  * @param actions  what a viewer may ask for, by name
  * @param threads  that answer
  */
private[watch] final class LiveServer(
    address: InetAddress,
    port: Int,
    page: String,
    observer: Observer,
    viewers: Viewers,
    state: () => LiveState,
    actions: Map[String, () => Unit],
    isEstimated: Boolean,
    threads: ExecutorService
) extends AutoCloseable:
  private val underWay = AtomicInteger()
  private val server = HttpServer.create(InetSocketAddress(address, port), 0)

  /** Available as soon as the server is. */
  val access: Access = Access(address, server.getAddress.getPort)

  server.setExecutor(threads)
  server.createContext("/", serve(_))
  server.start()

  /** Closes all connections, after the answers that are under way. */
  def close(): Unit =
    val begin = System.nanoTime
    while underWay.get > 0 && System.nanoTime - begin < LiveServer.Patience do Thread.sleep(5)
    server.stop(0)

  private def serve(exchange: HttpExchange): Unit =
    val _ = underWay.incrementAndGet()
    try answer(exchange)
    finally
      exchange.close()
      val _ = underWay.decrementAndGet()

  private def answer(exchange: HttpExchange): Unit =
    val path = exchange.getRequestURI.getPath
    val method = exchange.getRequestMethod
    def header(name: String) = Option(exchange.getRequestHeaders.getFirst(name))
    if !path.startsWith(access.root) || !access.allows(header("Host"), header("Origin")) then
      send(exchange, Answer.text("not found", 404))
    else
      val name = path.drop(access.root.length)
      val found = method match
        case "GET" => read(name, LiveServer.query(exchange.getRequestURI.getRawQuery))
        case "POST" => actions.get(name).map: act =>
            act()
            Answer.text("done")
        case _ => None
      send(exchange, found.getOrElse(Answer.text("not found", 404)))

  private def read(name: String, query: Map[String, String]): Option[Answer] =
    def number(key: String) = query.get(key).flatMap(_.toIntOption)
    name match
      case "" => Some(Answer("text/html", page.getBytes(UTF_8)))
      case "state" =>
        val isEnded = observer.isEnded
        val version = observer.snapshot.map(_.version)
        for viewer <- query.get("viewer") do
          viewers.saw(viewer, isEnded && version.isDefined && number("shown") == version)
        Some(Answer("application/json", LiveData.state(state()).getBytes(UTF_8)))
      case "charts" =>
        val charts = LiveData.charts(observer.points, isEstimated)
        Some(Answer("text/html", charts.getBytes(UTF_8)))
      case "image" =>
        for
          snapshot <- observer.snapshot
          layer <- query.get("layer")
          bytes <- snapshot.bytes(layer)
        yield Answer(
          "application/octet-stream",
          bytes.data,
          Vector("X-Version" -> snapshot.version, "X-Channels" -> bytes.channels)
            .map((key, value) => key -> value.toString) ++
            bytes.toSrgb.map(matrix => "X-To-Srgb" -> matrix.mkString(","))
        )
      case "pixel" =>
        for
          snapshot <- observer.snapshot
          x <- number("x") if x >= 0 && x < snapshot.image.width
          y <- number("y") if y >= 0 && y < snapshot.image.height
        yield Answer("application/json", LiveData.pixel(snapshot.at(x, y)).getBytes(UTF_8))
      case _ => None

  private def send(exchange: HttpExchange, answer: Answer): Unit =
    val headers = exchange.getResponseHeaders
    headers.set("Content-Type", s"${answer.kind}; charset=utf-8")
    headers.set("Cache-Control", "no-store")
    for (key, value) <- answer.headers do headers.set(key, value)
    // A viewer that has gone is no error.
    val _ = Try:
      exchange.sendResponseHeaders(answer.code, answer.body.length.toLong)
      exchange.getResponseBody.write(answer.body)

private[watch] object LiveServer:
  /** For viewers that don't read, in nanoseconds. */
  private val Patience = 1_000_000_000L

  private def query(raw: String | Null): Map[String, String] =
    val pairs = if raw == null then Array.empty[String] else raw.split('&')
    pairs.collect { case s"$key=$value" => key -> URLDecoder.decode(value, UTF_8) }.toMap

private final case class Answer(
    kind: String,
    body: Array[Byte],
    headers: Vector[(String, String)] = Vector.empty,
    code: Int = 200
)

private object Answer:
  def text(words: String, code: Int = 200): Answer =
    Answer("text/plain", words.getBytes(UTF_8), code = code)

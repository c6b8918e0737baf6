package candela.watch

import candela.report.{LiveData, LiveState}

import java.net.InetAddress
import java.nio.charset.StandardCharsets.UTF_8

/** Serves the live page.
  *
  * @param page     HTML
  * @param observer of the rendering
  * @param state    how far it is
  * @param actions  what a viewer may ask for, by name
  */
private[watch] final class LiveServer(
    address: InetAddress,
    port: Int,
    page: String,
    observer: Observer,
    viewers: Viewers,
    state: () => LiveState,
    actions: Map[String, () => Unit],
    isEstimated: Boolean
) extends AutoCloseable:
  private val server =
    HttpServer(address, port, PagePolicy.allowing(page), answer(_))

  /** Available as soon as the server is. */
  val access: Access = Access(address, server.port)

  server.start()

  /** Closes all connections, after the answers that are under way. */
  def close(): Unit = server.close()

  private def answer(request: Request): Answer =
    if !request.path.startsWith(access.root) || !access.allows(request.host, request.origin) then
      Answer.NotFound
    else
      val name = request.path.drop(access.root.length)
      val action = actions.get(name)
      request.method match
        case "POST" if action.isDefined =>
          action.foreach(_())
          Answer.text("done")
        case _ if action.isDefined => Answer.notAllowed("POST")
        case _ if !LiveServer.Readable(name) => Answer.NotFound
        case "GET" | "HEAD" => read(name, request.query).getOrElse(Answer.NotFound)
        case _ => Answer.notAllowed("GET, HEAD")

  private def read(name: String, query: Map[String, String]): Option[Answer] =
    def number(key: String) = query.get(key).flatMap(_.toIntOption)
    name match
      case "" => Some(Answer("text/html", page.getBytes(UTF_8)))
      case "state" =>
        val current = state()
        for viewer <- query.get("viewer") do
          viewers.saw(viewer, current.isFinal && number("shown").contains(current.version))
        val counted = current.copy(viewers = viewers.count)
        Some(Answer("application/json", LiveData.state(counted).getBytes(UTF_8)))
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
      case _ =>
        for
          snapshot <- observer.snapshot
          x <- number("x") if x >= 0 && x < snapshot.image.width
          y <- number("y") if y >= 0 && y < snapshot.image.height
        yield Answer("application/json", LiveData.pixel(snapshot.pixel(x, y)).getBytes(UTF_8))

private object LiveServer:
  /** Names of what can be read; the page is the first. */
  private val Readable = Set("", "state", "charts", "image", "pixel")

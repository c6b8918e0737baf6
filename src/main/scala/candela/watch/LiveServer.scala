package candela.watch

import candela.measure.CurvePoint
import candela.report.{LiveData, LiveState}

import java.net.{BindException, InetAddress}
import java.nio.charset.StandardCharsets.UTF_8

/** What the live page shows, and what its viewers may do. */
private[watch] abstract class LiveSource:
  def snapshot: Option[Snapshot]
  def state: LiveState

  /** Of the error curve. */
  def points: Vector[CurvePoint] = Vector.empty

  /** What viewers may ask for, by name. */
  def actions: Map[String, LiveSource.Action]

private[watch] object LiveSource:
  /** Given the query, does what is asked for; or why it doesn't. */
  type Action = Map[String, String] => Option[String]

  def action(body: => Unit): Action = _ =>
    body
    None

/** Serves the live page.
  *
  * @param page   HTML
  * @param source of what it shows
  */
private[watch] final class LiveServer(
    address: InetAddress,
    port: Int,
    page: String,
    source: LiveSource,
    viewers: Viewers,
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
      val action = source.actions.get(name)
      request.method match
        case "POST" if action.isDefined =>
          action.flatMap(_(request.query)).fold(Answer.text("done"))(Answer.text(_, 400))
        case _ if action.isDefined => Answer.notAllowed("POST")
        case _ if !LiveServer.Readable(name) => Answer.NotFound
        case "GET" | "HEAD" => read(name, request.query).getOrElse(Answer.NotFound)
        case _ => Answer.notAllowed("GET, HEAD")

  private def read(name: String, query: Map[String, String]): Option[Answer] =
    def number(key: String) = query.get(key).flatMap(_.toIntOption)
    name match
      case "" => Some(Answer("text/html", page.getBytes(UTF_8)))
      case "state" =>
        val current = source.state
        for viewer <- query.get("viewer") do
          viewers.saw(viewer, current.isFinal && number("shown").contains(current.version))
        val counted = current.copy(viewers = viewers.count)
        Some(Answer("application/json", LiveData.state(counted).getBytes(UTF_8)))
      case "charts" =>
        val charts = LiveData.charts(source.points, isEstimated)
        Some(Answer("text/html", charts.getBytes(UTF_8)))
      case "image" =>
        for
          snapshot <- source.snapshot
          layer <- query.get("layer")
          bytes <- snapshot.bytes(layer)
        yield Answer(
          "application/octet-stream",
          bytes.data,
          Vector(
            "X-Version" -> snapshot.version,
            "X-Channels" -> bytes.channels,
            "X-Width" -> snapshot.image.width,
            "X-Height" -> snapshot.image.height
          ).map((key, value) => key -> value.toString) ++
            bytes.toSrgb.map(matrix => "X-To-Srgb" -> matrix.mkString(","))
        )
      case _ =>
        for
          snapshot <- source.snapshot
          x <- number("x") if x >= 0 && x < snapshot.image.width
          y <- number("y") if y >= 0 && y < snapshot.image.height
        yield Answer("application/json", LiveData.pixel(snapshot.pixel(x, y)).getBytes(UTF_8))

private[watch] object LiveServer:
  private val DefaultPort = 8642

  /** Starts a server at an address. */
  def at(
      address: WatchAddress,
      page: String,
      source: LiveSource,
      viewers: Viewers,
      isEstimated: Boolean
  ): LiveServer =
    val host = address.host.fold(InetAddress.getLoopbackAddress)(InetAddress.getByName)
    def serve(port: Int) = LiveServer(host, port, page, source, viewers, isEstimated)
    address.port match
      case Some(port) => serve(port)
      case None =>
        try serve(DefaultPort)
        catch case _: BindException => serve(0)

  /** Names of what can be read; the page is the first. */
  private val Readable = Set("", "state", "charts", "image", "pixel")

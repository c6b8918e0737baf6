package candela.cli.rendering

import candela.diagnostics.{Code, Problem, SceneError}
import java.io.IOException
import java.net.UnknownHostException
import java.nio.file.Path

import candela.cli.options.Options
import candela.cli.terminal.{ProblemText, Terminal}
import candela.image.Image
import candela.job.Prepared
import candela.render.{Cancellation, Live, Rendering}
import candela.watch.{LiveView, Observer, TevDisplay, Viewers, WatchAddress}

/** Everything that follows a rendering from outside: the live page, an image viewer.
  *
  * @param save writes the image so far, and returns the files
  */
final class Watching(
    options: Options,
    scene: String,
    prepared: Prepared,
    reference: Option[Image],
    cancellation: Cancellation,
    terminal: Terminal,
    save: Rendering => String
) extends AutoCloseable:
  private val plan = prepared.plan
  private val viewers = Viewers()
  private var observer: Option[Observer] = None
  private var view: Option[LiveView] = None
  @volatile private var display: Option[TevDisplay] = None

  /** Begins to follow a rendering. */
  def start(live: Live): Unit =
    def isWatched = viewers.count > 0 || display.exists(_.isConnected)
    val observer = Observer(plan, reference, options.control.threads, live, () => isWatched)
    this.observer = Some(observer)
    display = options.displayServer.map: (host, port) =>
      TevDisplay(host, port, scene, observer, e => cannotReach(host, port, e))
    view = options.watch.map(serve(observer, _))

  private def serve(observer: Observer, address: WatchAddress): LiveView =
    val view = Watching.served(address):
      LiveView(
        scene,
        plan,
        prepared.warnings.distinct.map(ProblemText.format),
        address,
        observer,
        viewers,
        cancellation,
        isEstimated = reference.isEmpty,
        save,
        stays = options.watchAfter
      )
    // Elsewhere nobody can guess the link.
    if !options.quiet || address.host.isDefined then
      terminal.err.println(s"watch at ${view.link}")
    view

  private def cannotReach(host: String, port: Int, cause: IOException): Unit =
    if !options.quiet then
      val message = s"warning: no viewer at $host:$port yet: ${Watching.reason(cause)}"
      terminal.err.println(ProblemText.numbered(message, Code.Viewer))

  /** Shows the result; returns when the viewers need the page no longer. */
  def end(rendering: Rendering): Unit =
    observer.foreach(_.end(rendering))

  /** @param files written by the rendering */
  def await(files: Vector[Path]): Unit =
    display.foreach(_.await())
    view.foreach(_.await(files.map(_.toAbsolutePath.normalize.toString)))

  def close(): Unit =
    display.foreach(_.close())
    observer.foreach(_.close())
    view.foreach(_.close())

private[cli] object Watching:
  /** What is served at an address.
    *
    * @throws SceneError if that can't be used
    */
  def served[A](address: WatchAddress)(view: => A): A =
    try view
    catch
      case e: IOException =>
        val endpoint = (address.host ++ address.port.map(_.toString)).mkString(":")
        throw SceneError(Problem.general(
          Code.Viewer,
          s"can't serve the live page at $endpoint: ${reason(e)}",
          Some("choose another with --watch PORT or --watch ADDRESS:PORT")
        ))

  def reason(e: IOException): String = e match
    case unknown: UnknownHostException => s"no such host: ${unknown.getMessage}"
    case other => other.getMessage

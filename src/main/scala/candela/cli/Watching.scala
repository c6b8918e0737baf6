package candela.cli

import java.io.IOException
import java.net.UnknownHostException

import candela.base.{Problem, SceneError}
import candela.image.Image
import candela.render.{Cancellation, Live, Rendering, RenderPlan}
import candela.watch.{LiveView, Observer, Viewers, WatchAddress}

/** Everything that follows a rendering from outside: the live page.
  *
  * @param save writes the image so far, and returns the files
  */
final class Watching(
    options: Options,
    scene: String,
    plan: RenderPlan,
    reference: Option[Image],
    cancellation: Cancellation,
    terminal: Terminal,
    save: Rendering => String
) extends AutoCloseable:
  private val viewers = Viewers()
  private var observer: Option[Observer] = None
  private var view: Option[LiveView] = None

  /** Begins to follow a rendering. */
  def start(live: Live): Unit =
    val observer =
      Observer(plan, reference, options.threadCount, live, () => viewers.count > 0)
    this.observer = Some(observer)
    view = options.watch.map(serve(observer, _))

  private def serve(observer: Observer, address: WatchAddress): LiveView =
    try
      val view = LiveView(
        scene,
        plan,
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
    catch
      case e: UnknownHostException =>
        throw cannotServe(address, s"no such address: ${e.getMessage}")
      case e: IOException => throw cannotServe(address, e.getMessage)

  private def cannotServe(address: WatchAddress, cause: String): SceneError =
    val place = (address.host ++ address.port.map(_.toString)).mkString(":")
    val help = "choose another with --watch PORT or --watch ADDRESS:PORT"
    SceneError(Problem.general(s"can't serve the live page at $place: $cause", Some(help)))

  /** Shows the result; returns when the viewers need the page no longer. */
  def end(rendering: Rendering): Unit =
    observer.foreach(_.end(rendering))

  def await(): Unit = view.foreach(_.await())

  def close(): Unit =
    observer.foreach(_.close())
    view.foreach(_.close())

package candela.watch

import candela.base.Version
import candela.measure.CurvePoint
import candela.render.{Cancellation, Rendering, RenderPlan}
import candela.report.{Frame, LivePage, LiveState, Stage}

import java.util.UUID
import java.util.concurrent.{CountDownLatch, TimeUnit}

/** Where the live page is served.
  *
  * @param host address or name; None: the loopback address
  * @param port None: the usual one, or any if that is taken; 0: any
  */
final case class WatchAddress(host: Option[String], port: Option[Int])

/** The live page of a rendering: follows it until the end, and longer if it stays.
  *
  * @param warnings     of reading and building the scene
  * @param cancellation requested by the page's button
  * @param save         writes the image so far, and returns what to tell the viewers
  * @param stays        whether the page remains when rendering has ended
  */
final class LiveView(
    scene: String,
    plan: RenderPlan,
    warnings: Vector[String],
    address: WatchAddress,
    observer: Observer,
    viewers: Viewers,
    cancellation: Cancellation,
    isEstimated: Boolean,
    save: Rendering => String,
    stays: Boolean
) extends AutoCloseable:
  import LiveView.*

  private val run = UUID.randomUUID.toString
  private val ended = CountDownLatch(1)
  @volatile private var isStoppedHere = false
  @volatile private var saved: Option[String] = None
  @volatile private var files: Option[Vector[String]] = None

  private object source extends LiveSource:
    import LiveSource.action
    def snapshot: Option[Snapshot] = observer.snapshot
    def state: LiveState = LiveView.this.state
    override def points: Vector[CurvePoint] = observer.points
    val actions: Map[String, LiveSource.Action] = Map(
      "stop" -> action(stop()),
      "keep" -> action(observer.keepsOn.foreach(keeps => observer.keepOn(!keeps))),
      "save" -> action { saved = Some(save(observer.rendering)) },
      "end" -> action(ended.countDown())
    )

  private val server: LiveServer =
    val page = LivePage.html(scene, Version.current, plan.features, warnings, isEstimated)
    LiveServer.at(address, page, source, viewers, isEstimated)

  /** Address of the page. */
  def link: String = server.access.link

  /** Waits until viewers need the page no longer: if it stays, until one asks for the end or the
    * program is interrupted; then a moment, until all have the last image.
    *
    * @param written all files of the rendering
    */
  def await(written: Vector[String]): Unit =
    files = Some(written)
    while remains && !ended.await(100, TimeUnit.MILLISECONDS) do ()
    val deadline = System.nanoTime + LastImageTimeoutNanos
    while !viewers.haveAll && System.nanoTime < deadline &&
      !ended.await(50, TimeUnit.MILLISECONDS)
    do ()

  private def stop(): Unit =
    isStoppedHere ||= !cancellation.isRequested
    cancellation.request()

  /** The page's own button stops the rendering, not the page. */
  private def remains: Boolean = stays && (isStoppedHere || !cancellation.isRequested)

  def close(): Unit =
    server.close()

  private def state: LiveState =
    val rendering = observer.rendering
    val progress = observer.progress
    val rate = progress.done / Math.max(progress.seconds, 1e-9)
    val crop = plan.crop
    val isOver = observer.isEnded
    LiveState(
      run,
      observer.snapshot.fold(0)(_.version),
      if isOver then if rendering.isComplete then Stage.Done else Stage.Stopped
      else if cancellation.isRequested then Stage.Stopping
      else Stage.Rendering,
      Frame(crop.x0, crop.y0, crop.x1, crop.y1),
      observer.snapshot.fold(Vector.empty)(s => LayerTitles.titled(s.layers)),
      rendering.samplesDone,
      Option.unless(rendering.isOpenEnded)(rendering.samplesPerPixel),
      progress.fraction,
      progress.seconds,
      progress.outlook.left.filter(_ => !isOver),
      progress.outlook.rate.filter(_ => !isOver).getOrElse(rate),
      observer.tiles.map(t => Frame(t.x0, t.y0, t.x1, t.y1)),
      observer.points,
      viewers.count,
      observer.keepsOn,
      remains,
      saved,
      files
    )

object LiveView:
  /** Viewers have this long to get the last image. */
  private[watch] val LastImageTimeoutNanos = 5_000_000_000L

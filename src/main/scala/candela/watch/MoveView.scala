package candela.watch

import candela.base.Version
import candela.report.{Frame, LiveCamera, LivePage, LiveState, Stage}

import java.util.UUID
import java.util.concurrent.{CountDownLatch, TimeUnit}

/** A picture of a view, for viewers.
  *
  * @param samples    per pixel of the whole image; 0: it is smaller
  * @param isComplete whether it is the last one of its view
  * @param seconds    since the camera was moved
  */
final case class MovedPicture(
    snapshot: Snapshot,
    samples: Int,
    isComplete: Boolean,
    seconds: Double
)

/** A camera that viewers move. */
abstract class MovingCamera:
  def picture: Option[MovedPicture]
  def camera: LiveCamera

  /** Moves it, and waits for its picture; or why it doesn't. */
  def move(query: Map[String, String]): Option[String]

  /** Writes the camera to a file, and returns what to tell the viewers. */
  def save(): String

/** The page on which viewers move a camera.
  *
  * @param scene    as users named it
  * @param facts    features of the scene
  * @param frame    rendered pixels of the image
  * @param planned  samples per pixel
  * @param warnings of reading and building the scene
  */
final class MoveView(
    scene: String,
    facts: Vector[(String, String)],
    frame: Frame,
    planned: Int,
    warnings: Vector[String],
    address: WatchAddress,
    moving: MovingCamera
) extends AutoCloseable:
  private val run = UUID.randomUUID.toString
  private val ended = CountDownLatch(1)
  private val viewers = Viewers()
  @volatile private var saved: Option[String] = None

  private object source extends LiveSource:
    import LiveSource.action
    def snapshot: Option[Snapshot] = moving.picture.map(_.snapshot)
    def state: LiveState = MoveView.this.state
    val actions: Map[String, LiveSource.Action] = Map(
      "camera" -> moving.move,
      "save" -> action { saved = Some(moving.save()) },
      "end" -> action(ended.countDown())
    )

  private val server: LiveServer =
    val page =
      LivePage.html(scene, Version.current, facts, warnings, isEstimated = true, isMoving = true)
    LiveServer.at(address, page, source, viewers, isEstimated = true)

  /** Address of the page. */
  def link: String = server.access.link

  /** Waits until a viewer asks for the end, or the program is to end. */
  def await(isInterrupted: => Boolean): Unit =
    while !isInterrupted && !ended.await(100, TimeUnit.MILLISECONDS) do ()

  def close(): Unit = server.close()

  private def state: LiveState =
    val picture = moving.picture
    val (samples, seconds) = picture.fold((0, 0.0))(p => (p.samples, p.seconds))
    val isComplete = picture.exists(_.isComplete)
    val pixels = (frame.x1 - frame.x0).toDouble * (frame.y1 - frame.y0)
    LiveState(
      run,
      picture.fold(0)(_.snapshot.version),
      if isComplete then Stage.Done else Stage.Rendering,
      frame,
      picture.fold(Vector.empty)(p => LayerTitles.titled(p.snapshot.layers)),
      samples,
      Some(planned),
      if planned == 0 then 0 else samples.toDouble / planned,
      seconds,
      left = None,
      samples * pixels / Math.max(seconds, 1e-9),
      tiles = Vector.empty,
      points = Vector.empty,
      viewers.count,
      keepsOn = None,
      stays = true,
      saved,
      files = None,
      Some(moving.camera)
    )

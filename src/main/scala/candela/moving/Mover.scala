package candela.moving

import candela.diagnostics.{SceneError, SourcePos}
import candela.film.Film
import candela.image.Image
import candela.job.{CameraFile, Prepared, Render}
import candela.render.{
  Background, Cancellation, Live, Looks, Pass, RenderControl, RenderFailure, Rendering,
  RenderListener, RenderPlan
}
import candela.scenefile.{Declaration, Resolution, SceneDescription}
import candela.settings.{RenderRegion, RenderSettings}
import candela.report.LiveCamera
import candela.watch.{MovedPicture, MovingCamera, Snapshot}

/** A scene whose camera viewers move: shows each view at once with few pixels, then with more, and
  * renders it until it is moved again. The scene is built once.
  *
  * @param first   with the camera of the scene
  * @param rebuild builds the scene for a view far from that of `first`
  * @param file    where the camera is written
  */
final class Mover(
    first: Prepared,
    rebuild: SceneDescription => Prepared,
    threads: Int,
    file: CameraOutput
) extends MovingCamera, AutoCloseable:
  import Mover.*

  // Guarded by this object
  private var view = viewed(initial(first), first)
  private var cancellation = Cancellation()
  private var generation = 1
  private var rendered, pictured = 0
  private var isClosed = false
  private var secondsPerPixel = 1e-5

  @volatile private var latest = Option.empty[MovedPicture]
  @volatile private var failure = Option.empty[String]
  @volatile private var began = System.nanoTime

  private val loop = Background.repeat("mover", 0)(() => follow())

  def picture: Option[MovedPicture] = latest

  def camera: LiveCamera =
    val current = synchronized(view)
    val statement = current.camera.camera
    def number(name: String, default: Double) =
      Some(statement.param(name).flatMap(_.floats.headOption).fold(default)(_.toDouble))
    val hasLens = CameraMoves.Lenses(statement.name)
    LiveCamera(
      current.text.statements,
      current.text.native.map(n => (n.title, n.text)),
      if statement.name == "perspective" then number("fov", current.text.fov) else None,
      if hasLens then number("lensradius", 0) else None,
      if hasLens then number("focaldistance", 0)
      else if statement.name == "realistic" then number("focusdistance", 10)
      else None,
      CameraMoves.remarks(statement) ++ dropped,
      file.name,
      failure
    )

  private def dropped: Option[String] = Option.when(first.description.worldToCamera.isAnimated):
    "the camera's motion is dropped: this is where it starts"

  def save(): String = file.write(synchronized(view).text)

  def move(query: Map[String, String]): Option[String] =
    if query.get("move").contains("reset") then
      change((_, _) => initial(first))
    else CameraMoves.parse(query).fold(Some(_), change)

  private def change(move: CameraMoves.Move): Option[String] = synchronized:
    val changed =
      val moved = view.sight.fold(view.camera)(move(view.camera, _))
      try
        if moved.isUsable then Right(viewed(moved, view.prepared))
        else Left("the camera would be too near or too far away")
      catch case e: SceneError => Left(e.problems.head.message)
    changed match
      case Left(why) => Some(why)
      case Right(next) =>
        view = next
        generation += 1
        began = System.nanoTime
        cancellation.request()
        notifyAll()
        val (own, end) = (generation, System.nanoTime + AnswerNanos)
        while pictured < own && !isClosed && System.nanoTime < end do wait(20)
        None

  private var rebuilt = Option.empty[Prepared]

  private def built(description: SceneDescription): Prepared =
    val next = rebuild(description)
    rebuilt.foreach(_.close())
    rebuilt = Some(next)
    next

  /** The scene as a camera sees it: by the very statements that a file would have. */
  private def viewed(camera: MovedCamera, base: Prepared): MovedView =
    val scene = first.description
    val text = CameraText(
      scene.dialect,
      camera.camera,
      camera.pose,
      base.plan.width,
      base.plan.height
    )
    val description = CameraFile.ofText(scene, "camera", text.statements)
    val prepared = base.built.flatMap(_.seenAs(description, base.settings)) match
      case Some(plan) => base.copy(description = description, plan = plan)
      case None => built(description)
    MovedView(camera, text, prepared)

  def close(): Unit =
    synchronized:
      isClosed = true
      cancellation.request()
      notifyAll()
    loop.close()
    rebuilt.foreach(_.close())

  /** Renders the next view, as far as there is time. */
  private def follow(): Unit =
    val next = synchronized:
      if rendered == generation && !isClosed then wait(100)
      Option.when(!isClosed && rendered < generation):
        rendered = generation
        cancellation = Cancellation()
        (view, generation, cancellation)
    for (view, number, cancellation) <- next do
      failure = None
      try render(view, number, cancellation)
      catch
        case e: SceneError => fail(number, e.problems.head.message)
        case e: RenderFailure => fail(number, e.getMessage)

  private def fail(number: Int, why: String): Unit = synchronized:
    failure = Some(why)
    pictured = Math.max(pictured, number)
    notifyAll()

  private def render(view: MovedView, number: Int, cancellation: Cancellation): Unit =
    var divisor = firstDivisor(view.prepared.plan)
    var isFirst = true
    while divisor > 1 && !cancellation.isRequested do
      // Of many moves, each shows its first picture
      reduced(view, number, divisor, if isFirst then Cancellation() else cancellation)
      isFirst = false
      divisor /= 2
    if !cancellation.isRequested then complete(view, number, cancellation)

  /** Renders one sample for each pixel of a smaller image. */
  private def reduced(view: MovedView, number: Int, divisor: Int, until: Cancellation): Unit =
    val prepared = view.prepared
    for plan <- prepared.built.flatMap(_.seenAs(prepared.description, coarse(prepared, divisor))) do
      val start = System.nanoTime
      val control = RenderControl(threads, until)
      val rendering = Render.render(prepared.copy(plan = plan), control)
      if rendering.isComplete then
        publish(number, rendering.image(plan.development), 0, isComplete = false)
        val pixels = plan.crop.pixels
        if pixels >= ProbePixels then
          secondsPerPixel = (System.nanoTime - start) * 1e-9 / pixels

  /** Renders as `candela render --camera FILE` does. */
  private def complete(view: MovedView, number: Int, until: Cancellation): Unit =
    val prepared = view.prepared.copy(plan = view.prepared.plan.piloted)
    val listener = new RenderListener:
      private var live = Option.empty[Live]
      override def started(live: Live): Unit = this.live = Some(live)
      override def frequency: Looks = Looks.Doublings
      override def passed(pass: Pass, film: Film): Unit =
        for l <- live if !pass.isLast do
          val image = l.rendering.image(prepared.plan.development)
          publish(number, image, pass.samples, isComplete = false)
    val rendering = Render.render(prepared, RenderControl(threads, until, listener))
    if rendering.isComplete then
      val image = Render.develop(prepared, rendering, None)
      publish(number, image, rendering.samplesDone, isComplete = true)

  private def publish(number: Int, image: Image, samples: Int, isComplete: Boolean): Unit =
    synchronized:
      if number >= pictured then
        val version = latest.fold(1)(_.snapshot.version + 1)
        val elapsed = (System.nanoTime - began) * 1e-9
        latest = Some(MovedPicture(Snapshot(version, image, None), samples, isComplete, elapsed))
        pictured = number
        notifyAll()

  /** That of an image that is rendered in time. */
  private def firstDivisor(plan: RenderPlan): Int =
    val budget = FirstSeconds / secondsPerPixel
    Divisors.find(d => plan.crop.pixels / (d * d) <= budget).getOrElse(Divisors.last)

object Mover:
  /** The settings of a smaller image with one sample per pixel. */
  private def coarse(prepared: Prepared, divisor: Int): RenderSettings =
    val (settings, plan) = (prepared.settings, prepared.plan)
    def part(x: Int, size: Int) = x.toFloat / size
    val region = settings.region.pixels.fold(settings.region): p =>
      RenderRegion.Window(
        part(p.x0, plan.width),
        part(p.x1, plan.width),
        part(p.y0, plan.height),
        part(p.y1, plan.height)
      )
    val size = Resolution.Size(
      Math.max(1, plan.width / divisor),
      Math.max(1, plan.height / divisor)
    )
    settings.copy(
      samples = Some(1),
      region = region,
      reading = settings.reading.copy(resolution = Some(size))
    )

  /** The camera of a scene, at the start of its motion. */
  private def initial(prepared: Prepared): MovedCamera =
    val scene = prepared.description
    val plan = prepared.plan
    val camera = scene.camera.getOrElse:
      Declaration("Camera", "perspective", Vector.empty, SourcePos.Nowhere, scene.folder)
    val near = CameraPose.of(scene.worldToCamera.start, 1)
    val middle = CameraSight.of(prepared).flatMap(_.surface(0.5, 0.5)).map(near.eye.distance)
    val distance = middle.filter(_ > 0).getOrElse(1.0)
    MovedCamera(near.lookingAt(distance), windowed(camera, plan))

  /** An orthographic camera says how much it sees. */
  private def windowed(camera: Declaration, plan: RenderPlan): Declaration =
    if camera.name != "orthographic" || camera.param("screenwindow").exists(_.floats.length == 4)
    then camera
    else
      val written = camera.param("frameaspectratio").flatMap(_.floats.headOption).filter(_ > 0)
      val aspect = written.getOrElse(plan.width.toFloat / plan.height)
      val (x, y) = if aspect > 1 then (aspect, 1f) else (1f, 1 / aspect)
      CameraText.withFloats(camera, "screenwindow", -x, x, -y, y)

  /** From the whole image on. */
  private val Divisors = Vector(1, 2, 4, 8, 16, 32, 64)

  /** What the first picture may take. */
  private val FirstSeconds = 0.08

  /** Smaller images are no measure of the rate. */
  private val ProbePixels = 256

  /** How long a request waits for its picture. */
  private val AnswerNanos = 2_000_000_000L

package candela.moving

import candela.base.Decimal
import candela.cameras.Camera
import candela.geometry.{Hit, Ray}
import candela.job.Prepared
import candela.math.{Position, Vec3}
import candela.render.RenderPlan
import candela.scene.Scene
import candela.scenefile.Declaration

import CameraPose.*

/** A camera that is moved, and its statement. */
final case class MovedCamera(pose: CameraPose, camera: Declaration):

  /** Whether its numbers are such that it has a picture. */
  def isUsable: Boolean =
    def fits(x: Double) = x > MovedCamera.MinLength && x < MovedCamera.MaxLength
    val sides = camera.param("screenwindow").toVector.flatMap(_.floats)
    fits(pose.distance) && coordinates(pose.eye).forall(x => Math.abs(x) < MovedCamera.MaxLength) &&
    sides.forall(x => x == 0 || fits(Math.abs(x)))

private object MovedCamera:
  val MinLength = 1e-9
  val MaxLength = 1e9

/** The scene as it sees it.
  *
  * @param prepared with the plan of the view
  */
final case class MovedView(camera: MovedCamera, text: CameraText, prepared: Prepared):
  def sight: Option[CameraSight] = CameraSight.of(prepared)

/** What the camera of a plan sees.
  *
  * @param origin of the plan's world in that of the scene
  */
final class CameraSight(plan: RenderPlan, scene: Scene, origin: Position):
  private val camera: Camera = plan.camera
  private val crop = plan.crop
  private val ray = Ray()
  private val hit = Hit()
  private val point = scene.newPoint()

  /** Origin and direction of the ray through a point of the picture; none if its lenses block it.
    *
    * @param x from 0 on the left to 1 on the right, `y` from the top
    */
  def through(x: Double, y: Double): Option[(Position, Position)] =
    // Of an animated camera, at the shutter's opening
    ray.time = plan.shutter.fold(0f)(_.open)
    val (filmX, filmY) = (crop.x0 + x * crop.width, crop.y0 + y * crop.height)
    camera.generate(filmX.toFloat, filmY.toFloat, 0.5f, 0.5f, ray)
    Option.when(!camera.weighs || ray.weight > 0f):
      (inScene(ray.origin), unit(position(ray.direction)))

  /** The nearest surface there, if there is one. */
  def surface(x: Double, y: Double): Option[Position] =
    through(x, y).flatMap: _ =>
      ray.isPrimary = true
      Option.when(scene.closestBehindInterfaces(ray, hit, point))(inScene(point.p))

  private def position(v: Vec3) = Position(v.x, v.y, v.z)
  private def inScene(v: Vec3) = position(v) + origin

object CameraSight:
  def of(prepared: Prepared): Option[CameraSight] =
    for s <- prepared.plan.sight; b <- prepared.built
    yield CameraSight(prepared.plan, s.scene, b.origin)

/** What viewers ask of a camera. */
object CameraMoves:
  type Move = (MovedCamera, CameraSight) => MovedCamera

  /** The change that a request asks for; or why it is none.
    *
    * @param query `move` names it; x and y are in parts of width and height
    */
  def parse(query: Map[String, String]): Either[String, Move] =
    def number(name: String, least: Double, most: Double): Either[String, Double] =
      query.get(name).flatMap(Decimal.double(_)).filter(x => x >= least && x <= most)
        .toRight(s"`$name` must be a number from $least to $most")
    def drag(move: (Double, Double) => Move) =
      for x <- number("x", -MaxDrag, MaxDrag); y <- number("y", -MaxDrag, MaxDrag) yield move(x, y)
    def click(move: (Double, Double) => Move) =
      for x <- number("x", 0, 1); y <- number("y", 0, 1) yield move(x, y)
    query.get("move") match
      case Some("orbit") => drag(orbit(_, _, begins = query.contains("begin")))
      case Some("pan") => drag(pan)
      case Some("dolly") => number("by", -MaxSteps, MaxSteps).map(dolly)
      case Some("fov") => number("to", MinFov, MaxFov).map(fov)
      case Some("lens") => number("to", 0, MaxLength).map(lens)
      case Some("focus") => click(focus)
      case Some("aim") => click(aim)
      case Some(other) => Left(s"unknown move `$other`")
      case None => Left("`move` is missing")

  /** Around the target: half a turn across the picture.
    *
    * @param begins whether the target is to be the surface in the middle
    */
  private def orbit(x: Double, y: Double, begins: Boolean): Move = (camera, sight) =>
    val pose = camera.pose
    val middle = if begins then sight.surface(0.5, 0.5) else None
    val centred = middle.fold(pose)(p => pose.lookingAt(pose.eye.distance(p)))
    camera.copy(pose = centred.orbited(180 * x, 180 * y, centred.target))

  /** The target follows the pointer. */
  private def pan(x: Double, y: Double): Move = (camera, sight) =>
    val pose = camera.pose
    // Where a ray meets the plane of the target
    def onPlane(x: Double, y: Double) = sight.through(x, y).flatMap: (from, direction) =>
      val steepness = dot(direction, pose.forward)
      Option.when(steepness > 1e-3)(
        from + direction * (dot(pose.target - from, pose.forward) / steepness)
      )
    def edge(side: Double) = for a <- onPlane(0.5, 0.5); b <- onPlane(0.5 + side, 0.5) yield b - a
    def height(side: Double) = for a <- onPlane(0.5, 0.5); b <- onPlane(0.5, 0.5 + side) yield b - a
    // Of a panorama, whose rays go everywhere, as much as is seen ahead
    val size = 2 * pose.distance
    val across = edge(Probe).map(_ * (1 / Probe)).getOrElse(pose.right * size)
    val down = height(Probe).map(_ * (1 / Probe)).getOrElse(pose.above * -size)
    camera.copy(pose = pose.moved(across * -x + down * -y))

  /** Every step brings the target a tenth nearer. */
  private def dolly(steps: Double): Move = (camera, _) =>
    val factor = Math.pow(NearerByStep, steps)
    if camera.camera.name != "orthographic" then camera.copy(pose = camera.pose.nearer(factor))
    else
      val window = camera.camera.param("screenwindow").map(_.floats).filter(_.length == 4)
        .getOrElse(Array.emptyFloatArray)
      val values = window.map(x => (x / factor).toFloat).toSeq
      camera.copy(camera = CameraText.withFloats(camera.camera, "screenwindow", values*))

  private def fov(degrees: Double): Move = (camera, _) =>
    if camera.camera.name != "perspective" then camera
    else
      val statement = CameraText.withoutParams(camera.camera, "halffov")
      camera.copy(camera = CameraText.withFloats(statement, "fov", degrees.toFloat))

  private def lens(radius: Double): Move = (camera, _) =>
    if !Lenses(camera.camera.name) then camera
    else
      val focused =
        if camera.camera.param("focaldistance").nonEmpty then camera.camera
        else focusedAt(camera, camera.pose.target)
      camera.copy(camera = CameraText.withFloats(focused, "lensradius", radius.toFloat))

  private def focus(x: Double, y: Double): Move = (camera, sight) =>
    sight.surface(x, y).fold(camera)(p => camera.copy(camera = focusedAt(camera, p)))

  /** Makes the surface there the target, which is in the middle. */
  private def aim(x: Double, y: Double): Move = (camera, sight) =>
    sight.surface(x, y).fold(camera): p =>
      val pose = camera.pose
      camera.copy(pose = pose.copy(target = p, up = pose.above))

  /** In focus at the depth of a point. */
  private def focusedAt(camera: MovedCamera, p: Position): Declaration =
    val pose = camera.pose
    val depth = dot(p - pose.eye, pose.forward) * pose.inside.m(10)
    val name = if camera.camera.name == "realistic" then "focusdistance" else "focaldistance"
    val isFocusable = Lenses(camera.camera.name) || camera.camera.name == "realistic"
    if !isFocusable || !(depth > 0) then camera.camera
    else
      val decimals = 5 - Math.floor(Math.log10(depth)).toInt
      CameraText.withFloats(camera.camera, name, rounded(depth, decimals).toFloat)

  /** On what of a camera can't be changed. */
  def remarks(camera: Declaration): Vector[String] = camera.name match
    case "perspective" => Vector.empty
    case "orthographic" =>
      Vector("an orthographic camera has no field of view: + and - change how much it sees")
    case "realistic" => Vector("the lens file decides on the field of view and the lens radius")
    case other =>
      Vector(s"a \"$other\" camera sees all directions: it has no field of view and focus")

  /** Cameras with `lensradius` and `focaldistance`. */
  val Lenses: Set[String] = Set("perspective", "orthographic")

  private val NearerByStep = 1 / 0.9
  private val Probe = 0.01

  // Limits of requests
  private val MaxDrag = 4.0
  private val MaxSteps = 50.0
  private val MinFov = 0.1
  private val MaxFov = 179.0
  private val MaxLength = 1e9

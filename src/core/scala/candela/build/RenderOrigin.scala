package candela.build

import candela.math.Position
import candela.scenefile.{AnimatedTransform, GraphicsState, SceneDescription}

import java.util.Locale

/** The point of the scene's world that is the origin of what is built.
  *
  * Everything rendered has Float coordinates. Around a camera at 4,000,000 they are 0.25 apart; so
  * scenes far from their origin are built around a point near what the camera sees. All transforms
  * are Doubles until then. The point depends on the scene alone, and hardly on the camera's place
  * in it: frames of a sequence, parts and resumed renderings share it.
  *
  * @param reason in words; empty for the world's own origin
  */
private[build] final class RenderOrigin(val position: Position, val reason: String = ""):

  def describe: Option[String] =
    Option.when(!position.isOrigin):
      val point = Seq(position.x, position.y, position.z).map(RenderOrigin.plain).mkString(" ")
      s"$point, because $reason"

  /** The scene, with transforms to and from a world around this point. Objects keep theirs. */
  def recentre(d: SceneDescription): SceneDescription =
    if position.isOrigin then d
    else
      d.copy(
        worldToCamera = toCamera(d.worldToCamera),
        textures = d.textures.map(t => t.copy(textureToWorld = moved(t.textureToWorld))),
        lights = d.lights.map(l => l.copy(lightToWorld = moved(l.lightToWorld))),
        shapes = d.shapes.map(s => s.copy(objectToWorld = moved(s.objectToWorld))),
        instances = d.instances.changed(i => i.copy(instanceToWorld = moved(i.instanceToWorld))),
        media = d.media.map(m => m.copy(mediumToWorld = moved(m.mediumToWorld))),
        volumes = d.volumes.map(v => v.copy(lightToWorld = moved(v.lightToWorld)))
      )

  /** The transform from this world to a camera. */
  def toCamera(fromWorld: AnimatedTransform): AnimatedTransform =
    if position.isOrigin then fromWorld else mapped(fromWorld)(_ * position.fromOrigin)

  private def moved(t: AnimatedTransform): AnimatedTransform = mapped(t)(position.toOrigin * _)

  private def mapped(t: AnimatedTransform)(f: candela.math.Transform => candela.math.Transform) =
    if t.start eq t.end then GraphicsState.constant(f(t.start))
    else AnimatedTransform(f(t.start), f(t.end))

private[build] object RenderOrigin:
  val World: RenderOrigin = RenderOrigin(Position.Origin)

  /** Scenes that are nearer to the world's origin keep it: Floats are 0.001 apart there. */
  private val NearDistance = 8192.0

  /** How many times its size a scene must be away, that rounding shows: from a million times on, a
    * scene is a few Floats wide; at 64, an image of a thousand pixels is still exact.
    */
  private val Times = 64.0

  def of(d: SceneDescription): RenderOrigin =
    val camera = d.worldToCamera.start
    if camera.isFlat || d.camera.isEmpty then World
    else
      val eye = camera.inverse.position(Position.Origin)
      // Before anything is measured: almost all scenes end here
      if !isFar(eye) then World
      else
        val extents = SceneSurvey(d).extents()
        originNear(
          if d.camera.exists(_.name == "orthographic") then nearest(d, extents) else eye,
          extents
        )

  /** The point of an object, by the same rule, or its own origin.
    *
    * @param looks whether to look into files
    */
  def ofObject(shapes: Vector[candela.scenefile.ShapeDescription], looks: Boolean): Position =
    val extents = shapes.flatMap(SceneSurvey.extent(_, looks))
    val middle = median(extents.map(_.middle))
    if extents.isEmpty || !isFar(middle) then Position.Origin
    else originNear(middle, extents).position

  private def isFar(p: Position) = p.reach >= NearDistance && p.reach < 1e15

  private def originNear(eye: Position, extents: Vector[Extent]): RenderOrigin =
    val sizes = extents.map(e => Math.max(e.size, e.middle.distance(eye)))
    val size = if sizes.isEmpty then 0.0 else sizes.sorted.apply((sizes.size - 1) / 4)
    if !(eye.reach >= Times * size) then World
    else
      val nearby = extents.lazyZip(sizes).filter((_, s) => eye.reach >= Times * s).map((e, _) => e)
      val point = if nearby.isEmpty then eye else median(nearby.toVector.map(_.middle))
      val step = Math.ulp(eye.reach.toFloat).toDouble
      val rounding = (if step >= 0.1 then "%.2g" else "%.1g").formatLocal(Locale.ROOT, step)
      RenderOrigin(
        snapped(point, eye.reach),
        s"at the camera, ${plain(eye.reach)} from the world's origin, Floats are $rounding " +
          s"apart; the size or distance of visible shapes is ${plain(size)}"
      )

  /** Rounds to so few digits that frames of a sequence agree, while the rest is small. */
  private def snapped(p: Position, reach: Double): Position =
    val grid = Math.scalb(1.0, Math.getExponent(reach) - 16)
    def snap(x: Double) = Math.rint(x / grid) * grid + 0.0
    Position(snap(p.x), snap(p.y), snap(p.z))

  private def median(points: Vector[Position]): Position =
    def middle(of: Position => Double) =
      if points.isEmpty then 0.0 else points.map(of).sorted.apply((points.size - 1) / 2)
    Position(middle(_.x), middle(_.y), middle(_.z))

  /** The eye of an orthographic camera, moved along its axis to what it sees. */
  private def nearest(d: SceneDescription, extents: Vector[Extent]): Position =
    val target = d.worldToCamera.start.position(median(extents.map(_.middle)))
    d.worldToCamera.start.inverse.position(Position(0, 0, target.z))

  private def plain(x: Double): String =
    if x == Math.rint(x) && Math.abs(x) < 1e15 then x.toLong.toString
    else "%.3g".formatLocal(Locale.ROOT, x)

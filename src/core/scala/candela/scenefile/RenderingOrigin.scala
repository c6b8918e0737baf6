package candela.scenefile

import candela.math.{Interpolation, Motion, Still, Transform, Vec3}

/** The point that pbrt-v4 puts at its origin, to which the translations of moving instances are
  * relative: the camera's position half-way, unless an option chooses the world's origin.
  */
object RenderingOrigin:
  val Option = "rendercoordsys"
  val World = "world"
  private val Camera = "camera"

  def of(scene: SceneDescription): Vec3 =
    if space(scene).contains(World) then Vec3.Zero else midTransform(scene).point(Vec3.Zero)

  /** From the coordinates in which pbrt-v4 renders. */
  def toWorld(scene: SceneDescription): Transform =
    if space(scene).contains(Camera) then midTransform(scene)
    else
      val o = of(scene)
      Transform.translate(o.x, o.y, o.z)

  /** The scene with these media relative to where it is rendered from: pbrt-v4 reads them before it
    * knows the camera.
    */
  def placing(media: collection.Set[String], scene: SceneDescription): SceneDescription =
    if media.isEmpty then scene
    else
      val renderToWorld = toWorld(scene)
      def moved(t: AnimatedTransform) =
        if t.start eq t.end then GraphicsState.constant(renderToWorld * t.start)
        else AnimatedTransform(renderToWorld * t.start, renderToWorld * t.end)
      scene.copy(media = scene.media.map: m =>
        if media(m.name) then m.copy(mediumToWorld = moved(m.mediumToWorld)) else m)

  private def space(scene: SceneDescription) =
    // The last of several counts
    scene.options.filter(_.name == Option).lastOption.flatMap(_.strings.headOption)

  /** The camera's transform half-way; none of a camera that can't be placed. */
  private def midTransform(scene: SceneDescription): Transform =
    if scene.worldToCamera.start.isFlat then Transform.Identity else middle(scene)

  private def middle(scene: SceneDescription): Transform =
    val (startTime, endTime) = scene.transformTimes
    camera(scene).transform((startTime + endTime) / 2)

  private def camera(scene: SceneDescription): Motion =
    val AnimatedTransform(start, end) = scene.worldToCamera
    val (startTime, endTime) = scene.transformTimes
    val moves = scene.worldToCamera.isAnimated &&
      Seq(start, end).forall(t => t.isAffine && !t.isFlat)
    if moves then Interpolation(start.inverse, end.inverse, startTime, endTime, shortest = true)
    else Still(start.inverse)

package candela.scenefile

import candela.math.{Interpolation, Motion, Still, Vec3}

/** The point that pbrt-v4 puts at its origin, to which the translations of moving instances are
  * relative: the camera's position half-way, unless an option chooses the world's origin.
  */
object RenderingOrigin:
  val Option = "rendercoordsys"
  val World = "world"

  def of(scene: SceneDescription): Vec3 =
    // The last of several counts
    val space = scene.options.filter(_.name == Option).lastOption.flatMap(_.strings.headOption)
    if space.contains(World) then Vec3.Zero
    else
      val (startTime, endTime) = scene.transformTimes
      camera(scene).transform((startTime + endTime) / 2).point(Vec3.Zero)

  private def camera(scene: SceneDescription): Motion =
    val AnimatedTransform(start, end) = scene.worldToCamera
    val (startTime, endTime) = scene.transformTimes
    val moves = scene.worldToCamera.isAnimated &&
      Seq(start, end).forall(t => t.isAffine && !t.isFlat)
    if moves then Interpolation(start.inverse, end.inverse, startTime, endTime, shortest = true)
    else Still(start.inverse)

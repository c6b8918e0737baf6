package candela.build

import candela.build.recipe.{Findings, Rules}
import candela.diagnostics.{Code, SourcePos}
import candela.math.*
import candela.scenefile.{AnimatedTransform, Dialect, RenderingOrigin, SceneDescription}

/** Motions of shapes, instances and the camera, by the rules of the dialect.
  *
  * @param description around its render origin
  */
private[build] final class Motions(description: SceneDescription, origin: Position):
  private val isV2 = description.dialect == Dialect.V2

  /** Motion of a shape or an instance in the world. pbrt-v2 interpolates the inverse transform,
    * whose translation depends on the world's own origin.
    */
  def of(t: AnimatedTransform): Motion =
    if isV2 && t.isAnimated && !origin.isOrigin then
      val inWorld = AnimatedTransform(origin.fromOrigin * t.start, origin.fromOrigin * t.end)
      RecentredMotion(inObject(inWorld), Position.Origin, origin)
    else inObject(t)

  /** Motion of a shape in an object. */
  def inObject(t: AnimatedTransform): Motion =
    if !t.isAnimated then Still(t.start)
    else if isV2 then InverseMotion(interpolate(t.start.inverse, t.end.inverse))
    else interpolate(t.start, t.end)

  /** Motion of the camera, if animated. */
  val camera: Option[Motion] =
    val AnimatedTransform(start, end) = description.worldToCamera
    Option.when(Motions.moves(description.worldToCamera))(interpolate(start.inverse, end.inverse))

  /** Motion of an instance. pbrt-v4 takes its translation relative to where it renders from. */
  def ofInstance(t: AnimatedTransform): Motion =
    if t.isAnimated && description.dialect.base == Dialect.V4 then
      interpolate(t.start, t.end, v4Origin)
    else of(t)

  /** Warns of a motion that pbrt-v3 and v4 interpolate otherwise: they take the mirroring for a
    * rotation.
    */
  def warnOfMirror(t: AnimatedTransform, at: SourcePos, problems: Findings): Unit =
    val isConcerned = description.dialect == Dialect.V3 || description.dialect == Dialect.V4
    if isConcerned && (t.start.swapsHandedness || t.end.swapsHandedness) then
      problems.warn(
        Code.UnlikePbrt,
        at,
        s"this transform is animated and mirrors; ${Rules.of(description.dialect).program} can't " +
          "interpolate such transforms, so its image differs"
      )

  private lazy val v4Origin: Vec3 = RenderingOrigin.of(description)

  private def interpolate(start: Transform, end: Transform, origin: Vec3 = Vec3.Zero): Motion =
    val (startTime, endTime) = description.transformTimes
    Interpolation(start, end, startTime, endTime, shortest = !isV2, origin)

private[build] object Motions:
  /** Whether the transform is invertible and not perspective. */
  def isAffine(t: AnimatedTransform): Boolean =
    isAffine(t.start) && ((t.end eq t.start) || isAffine(t.end))

  private def isAffine(map: Transform): Boolean = map.isAffine && !map.isFlat

  /** Whether the motion can be rendered. Others have no polar decomposition. */
  def moves(t: AnimatedTransform): Boolean = t.isAnimated && isAffine(t)

  def notAnimated(what: String): String =
    s"$what can't be animated; using the transform at the start"

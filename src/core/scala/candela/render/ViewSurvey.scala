package candela.render

import candela.diagnostics.SourcePos
import candela.geometry.{Hit, Ray}
import candela.math.{Pi, sqrt, Vec3}
import candela.scene.{PathReport, Scene}

/** What cameras can see.
  *
  * @param statement place of the statement of an object, by the scene's index of objects
  * @param camera    place of the camera's statement
  */
final case class Sight(
    scene: Scene,
    statement: Int => Option[SourcePos],
    camera: Option[SourcePos]
)

/** The surfaces that some rays meet first.
  *
  * @param rays      number of rays
  * @param hits      number of those that meet a surface
  * @param borders   number of the others, that pass interfaces, such as borders of media
  * @param distance  to the nearest surface
  * @param statement of the nearest surface
  */
final case class FirstSurfaces(
    rays: Int,
    hits: Int,
    borders: Int,
    distance: Float,
    statement: Option[SourcePos]
):
  def hitsNothing: Boolean = hits + borders == 0
  def hitsMediaOnly: Boolean = hits == 0 && borders > 0
  def isAround: Boolean = rays > 0 && hits == rays

/** Looks through the pixels of a plan's image, before or after it is rendered. */
final class ViewSurvey(plan: RenderPlan, sight: Sight):
  import ViewSurvey.*

  private val ray = Ray()
  private val hit = Hit()
  private val point = sight.scene.newPoint()

  /** What rays through a grid meet; through a finer one, if they meet nothing. */
  lazy val firstSurfaces: FirstSurfaces =
    val coarse = surveyGrid(GridSize)
    if coarse.hitsNothing then surveyGrid(FineGridSize) else coarse

  /** Whether rays from the camera in all directions meet a surface. */
  lazy val isEnclosed: Boolean = firstSurfaces.isAround && setCameraRay(0.5f, 0.5f) &&
    survey(Directions)(setSphereRay(ray.origin, _)).isAround

  /** Whether no sample of a grid of pixels has any light. Photons take too long to tell. */
  lazy val isDark: Boolean = !plan.method.blurs && {
    val crop = plan.crop
    val (columns, rows) = (Math.min(GridSize, crop.width), Math.min(GridSize, crop.height))
    (0 until columns * rows).forall: i =>
      val x = crop.x0 + (2 * (i % columns) + 1) * crop.width / (2 * columns)
      val y = crop.y0 + (2 * (i / columns) + 1) * crop.height / (2 * rows)
      Renderer.trace(plan, x, y, sample = 0, PathReport(_ => ())).exists(_.isBlack)
  }

  /** What the rays through the points of a grid meet. */
  private def surveyGrid(size: Int): FirstSurfaces = survey(size * size): i =>
    setCameraRay((i % size + 0.5f) / size, (i / size + 0.5f) / size)

  /** Sets the ray through a point of the crop; false if the camera has none there.
    *
    * @param u from the left, with `v` from the top, in [0, 1]
    */
  private def setCameraRay(u: Float, v: Float): Boolean =
    ray.weight = 1f
    for shutter <- plan.shutter do ray.time = shutter.at(0.5f)
    val crop = plan.crop
    plan.camera.generate(crop.x0 + u * crop.width, crop.y0 + v * crop.height, 0.5f, 0.5f, ray)
    ray.weight != 0f

  /** Sets one of the rays from a point in all directions: a Fibonacci spiral. */
  private def setSphereRay(origin: Vec3, i: Int): Boolean =
    val z = 1 - (2 * i + 1f) / Directions
    val radius = sqrt(Math.max(0f, 1 - z * z))
    val phi = i * GoldenAngle
    val w = Vec3(radius * Math.cos(phi).toFloat, radius * Math.sin(phi).toFloat, z)
    ray.set(origin, w, Float.PositiveInfinity)
    true

  /** What `count` rays meet.
    *
    * @param set sets the ray of a number; false: there is none
    */
  private def survey(count: Int)(set: Int => Boolean): FirstSurfaces =
    var rays, hits, borders = 0
    var distance = Float.PositiveInfinity
    var nearest = -1
    for i <- 0 until count if set(i) do
      val origin = ray.origin
      rays += 1
      if sight.scene.closestBehindInterfaces(ray, hit, point) then
        hits += 1
        val d = (point.p - origin).length
        if d < distance then
          distance = d
          nearest = sight.scene.objectIndex(hit)
      else if ray.origin != origin then borders += 1
    FirstSurfaces(
      rays,
      hits,
      borders,
      distance,
      if nearest < 0 then None else sight.statement(nearest)
    )

object ViewSurvey:
  private val GridSize = 16
  private val FineGridSize = 256
  private val Directions = 64
  private val GoldenAngle = Pi * (3 - sqrt(5f))

  /** Of the whole image or its crop. */
  def of(plan: RenderPlan): Option[ViewSurvey] = plan.sight.map(ViewSurvey(plan, _))

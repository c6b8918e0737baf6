package candela.integrators

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.lights.LightSample
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.scene.Scene

/** Transmittance of shadow rays through media and interfaces. Mutable, one per worker.
  *
  * @param work         `shadow` receives the transmittance
  * @param crossesPanes whether shadow rays pass panes, too
  */
private[candela] final class MediumVisibility(
    scene: Scene,
    media: SceneMedia,
    work: MediumWork,
    crossesPanes: Boolean = false
):
  private val isCrossed = scene.hasInterfaces || scene.hasVeils || crossesPanes
  private val ray = Ray()
  private val hit = Hit()
  private val border = ShadingPoint()
  private var rays = 0L

  def raysTraced: Long = rays

  /** Starts a new camera path. */
  def start(time: Float): Unit = ray.time = time

  /** Sets `work.shadow` to the transmittance between the light and `origin`, which lies in
    * `medium`; false if it is zero.
    */
  def reaches(origin: Vec3, light: LightSample, medium: Int): Boolean =
    if !light.isInfinite then reaches(origin, LightConnection.end(light), medium)
    else if isCrossed then reaches(origin, origin + light.wi * media.reach, medium)
    else
      work.shadow.start(work.weights.hero, 1f)
      ray.set(origin, light.wi, Float.PositiveInfinity)
      rays += 1
      !scene.isOccluded(ray, hit) && {
        ray.tMax = media.reach
        attenuate(medium)
      }

  /** As above, between two points. */
  def reaches(origin: Vec3, end: Vec3, medium: Int): Boolean =
    work.shadow.start(work.weights.hero, 1f)
    if isCrossed then passes(origin, end, medium)
    else
      ray.set(origin, end - origin, LightConnection.ShadowEnd)
      rays += 1
      !scene.isOccluded(ray, hit) && attenuate(medium)

  /** Whether light passes the border in its direction, which then attenuates it. */
  private def isPane: Boolean =
    scene.isPane(border) && {
      val passed = scene.straight(border, ray.direction.normalized)
      work.shadow.scale(passed)
      !passed.isBlack
    }

  private def attenuate(medium: Int): Boolean =
    if medium >= 0 then media(medium).attenuate(ray, work)
    !work.shadow.isDead

  private def passes(origin: Vec3, end: Vec3, first: Int): Boolean =
    var medium = first
    def aim(from: Vec3): Unit = ray.set(from, end - from, LightConnection.ShadowEnd)
    aim(origin)
    rays += 1
    LightConnection.reaches(
      scene,
      ray,
      hit,
      border,
      opens = scene.isPassed(ray, hit, border) || crossesPanes && isPane,
      crossed = direction =>
        rays += 1
        medium = media.beyond(border, direction, medium)
      ,
      segment = attenuate(medium),
      aim = aim
    )

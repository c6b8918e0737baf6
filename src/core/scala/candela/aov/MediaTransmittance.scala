package candela.aov

import candela.geometry.{Ray, ShadingPoint}
import candela.math.Vec3
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.SampleHash
import candela.scene.Scene

/** An estimate of what media leave of light from behind them, along a camera ray. Mutable, one per
  * worker.
  */
final class MediaTransmittance(scene: Scene, media: SceneMedia):
  private val work = MediumWork()
  private var medium = -1

  def copy(): MediaTransmittance = MediaTransmittance(scene, media)

  /** Starts a camera ray.
    *
    * @param sample number of the pixel's sample
    */
  def start(ray: Ray, sample: Int): Unit =
    medium = media.camera
    work.random.seed(SampleHash.ofRay(ray) + sample)
    work.shadow.start((3f * work.random.next()).toInt, 1f)

  /** Passes a segment up to the next surface, or past the scene; changes the ray's end. */
  def pass(ray: Ray): Unit =
    if ray.tMax.isInfinite then
      ray.tMax = (ray.origin - scene.ball.center).length + scene.ball.radius
    if medium >= 0 then media(medium).attenuate(ray, work)

  /** Goes on behind a surface. */
  def cross(at: ShadingPoint, direction: Vec3): Unit = medium = media.beyond(at, direction, medium)

  /** The mean of the colours. */
  def mean: Float =
    val s = work.shadow
    if s.isDead then 0f else s.throughput.average / s.lightRatio

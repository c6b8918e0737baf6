package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.geometry.Ray
import candela.media.{MediumWork, SceneMedia}

/** A straight part of a path through a medium, which scatters light of photons to the path.
  * Mutable, one per worker.
  *
  * @param work `weights` are those of the path where the segment begins; `shadow` is overwritten
  */
final class MediumSegment(media: SceneMedia, work: MediumWork):
  private val stepRay = Ray()
  private var along = Ray()
  private var reached = 0f

  /** Index of the medium. */
  var medium: Int = -1

  /** Scattered radiance, towards the begin of the segment. */
  val radiance: MutableRgb = MutableRgb()

  /** The segment: up to `tMax`. */
  def ray: Ray = along

  private[integrators] def start(along: Ray, medium: Int): Unit =
    this.along = along
    this.medium = medium
    reached = 0f
    radiance.set(Rgb.Black)
    work.shadow.start(work.weights.hero, 1f)

  /** Goes on to the parameter `t` of the ray, which is at least that of the last step; false if no
    * light comes from there.
    */
  def goTo(t: Float): Boolean =
    val step = t - reached
    if step > 0f then
      stepRay.time = along.time
      stepRay.set(along.at(reached), along.direction, step)
      media(medium).attenuate(stepRay, work)
      reached = t
    !work.shadow.isDead

  /** Attenuates the path by what is between the segment's begin and here. */
  private[integrators] def attenuate(): Unit =
    val s = work.shadow
    work.weights.scale(s.throughput)
    // Light samples pass with the same density
    work.weights.scaleDensity(s.lr, s.lg, s.lb)
    work.weights.scaleLight(s.lr, s.lg, s.lb)
    work.weights.balance()

  /** Adds light that is scattered here.
    *
    * @param wx,wy,wz unit vector to where it comes from
    * @param r,g,b    scattered power per area across the segment
    */
  def add(wx: Float, wy: Float, wz: Float, r: Float, g: Float, b: Float): Unit =
    val w = work.weights
    val s = work.shadow
    if s.isLost then w.discard()
    val density = (w.ur * s.lr + w.ug * s.lg + w.ub * s.lb) * (1f / 3f)
    if density > 0f then
      val toPath = -(wx * along.dx + wy * along.dy + wz * along.dz)
      val factor = media(medium).phase.value(toPath / along.direction.length) / density
      radiance.r += s.r * r * factor
      radiance.g += s.g * g * factor
      radiance.b += s.b * b * factor

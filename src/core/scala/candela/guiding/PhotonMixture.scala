package candela.guiding

import candela.math.*
import candela.sampling.Warp

/** The lobes of the photons around one point. Mutable, one per worker.
  *
  * Of the angle θ to its axis, a lobe has the density (1 + 2a) / (4π (1 + a (1 − cos θ))²): much
  * like a normal distribution near the axis, but with tails. Light beside all lobes is found seldom
  * by them, too, and so doesn't count as much as that which BSDF sampling finds alone.
  */
final class PhotonMixture extends LobeMixture(PhotonMixture.MaxLobes):
  import PhotonField.*
  private val sharpness = new Array[Float](PhotonMixture.MaxLobes)

  /** Takes the lobes of the photons around a point of this side ([[GuideField.side]]); false if
    * there are none.
    */
  def locate(field: PhotonField, p: Vec3, side: Int): Boolean =
    val region = field.region(side, placeOf(p))
    val from = field.data
    var at = field.begin(region) * Size
    count = field.end(region) - field.begin(region)
    var k = 0
    while k < count do
      val dx = p.x - from(at)
      val dy = p.y - from(at + 1)
      val dz = p.z - from(at + 2)
      val c = at + Change
      val x = from(at + Direction) + from(c) * dx + from(c + 1) * dy + from(c + 2) * dz
      val y = from(at + Direction + 1) + from(c + 3) * dx + from(c + 4) * dy + from(c + 5) * dz
      val z = from(at + Direction + 2) + from(c + 6) * dx + from(c + 7) * dy + from(c + 8) * dz
      turn(k, x, y, z)
      sharpness(k) = from(at + Sharpness)
      factors(k) = from(at + Factor)
      ends(k) = from(at + End)
      at += Size
      k += 1
    count > 0

  /** Solid-angle density. */
  def pdf(w: Vec3): Float =
    val x = w.x
    val y = w.y
    val z = w.z
    var sum = 0f
    var k = 0
    while k < count do
      // 1 − cos θ is half the squared distance of the unit vectors, without cancellation
      val apart = square(xs(k) - x) + square(ys(k) - y) + square(zs(k) - z)
      sum += factors(k) / square(1f + sharpness(k) * 0.5f * apart)
      k += 1
    sum

  /** Samples a direction into `to`: `u` chooses the lobe and the angle to its axis. */
  def sample(u: Float, v: Float, to: MutableVec3): Unit =
    val k = chosen(u)
    val part = within(u, k)
    val down = Math.min(2f * part / (1f + 2f * sharpness(k) * (1f - part)), 2f)
    val sin = sqrt(Math.max(0f, down * (2f - down)))
    to.set(frame(k).toWorld(Warp.around(1f - down, sin, v)))

object PhotonMixture:
  /** Lobes of a region, at most. */
  private[guiding] inline val MaxLobes = 16

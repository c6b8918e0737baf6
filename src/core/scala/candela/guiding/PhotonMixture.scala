package candela.guiding

import candela.geometry.Frame
import candela.math.*
import candela.sampling.Warp

/** The lobes of the photons around one point. Mutable, one per worker.
  *
  * Of the angle θ to its axis, a lobe has the density (1 + 2a) / (4π (1 + a (1 − cos θ))²): much
  * like a normal distribution near the axis, but with tails. Light beside all lobes is found seldom
  * by them, too, and so doesn't count as much as that which BSDF sampling finds alone.
  */
final class PhotonMixture:
  import PhotonField.*
  import PhotonMixture.Most
  private val xs, ys, zs, sharpness, factors, ends = new Array[Float](Most)
  private val place = new Array[Float](3)
  private var count = 0

  /** Takes the lobes of the photons around a point of this side ([[GuideField.side]]); false if
    * there are none.
    */
  def locate(field: PhotonField, p: Vec3, side: Int): Boolean =
    place(0) = p.x
    place(1) = p.y
    place(2) = p.z
    val region = field.region(side, place)
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
      val s = 1f / Math.max(sqrt(x * x + y * y + z * z), 1e-12f)
      xs(k) = x * s
      ys(k) = y * s
      zs(k) = z * s
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
    var k = 0
    while k < count - 1 && u >= ends(k) do k += 1
    val begin = if k == 0 then 0f else ends(k - 1)
    val within = Math.max(0f, Math.min((u - begin) / (ends(k) - begin), 1f))
    val down = Math.min(2f * within / (1f + 2f * sharpness(k) * (1f - within)), 2f)
    val sin = sqrt(Math.max(0f, down * (2f - down)))
    val frame = Frame.around(Vec3(xs(k), ys(k), zs(k)))
    to.set(frame.toWorld(Warp.around(1f - down, sin, v)))

object PhotonMixture:
  /** Lobes of a region. */
  private[guiding] inline val Most = 16

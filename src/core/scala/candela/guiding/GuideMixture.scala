package candela.guiding

import candela.math.*
import candela.sampling.Warp

/** The mixture of a region as seen from one point. Mutable, one per worker. */
final class GuideMixture extends LobeMixture(GuideField.Lobes):
  import GuideField.*
  import Lobe.*
  private val kappas = new Array[Float](Lobes)

  /** The region of a point of this side ([[GuideField.side]]). */
  def region(field: GuideField, p: Vec3, side: Int): Int =
    field.region(side, placeOf(p), 0)

  /** Takes the mixture of the region, as seen from `p`. */
  def locate(field: GuideField, region: Int, p: Vec3): Unit =
    val cx = field.centres(3 * region) - p.x
    val cy = field.centres(3 * region + 1) - p.y
    val cz = field.centres(3 * region + 2) - p.z
    val from = field.lobes
    count = field.used(region)
    var at = region * Lobes * Size
    var k = 0
    while k < count do
      val near = from(at + Nearness)
      val x = from(at) + cx * near
      val y = from(at + 1) + cy * near
      val z = from(at + 2) + cz * near
      turn(k, x, y, z)
      kappas(k) = from(at + Kappa)
      ends(k) = from(at + End)
      factors(k) = from(at + Factor)
      at += Size
      k += 1

  /** Solid-angle density. */
  def pdf(w: Vec3): Float =
    val x = w.x
    val y = w.y
    val z = w.z
    var sum = 0f
    var k = 0
    while k < count do
      sum += factors(k) * exp(kappas(k) * (xs(k) * x + ys(k) * y + zs(k) * z - 1f))
      k += 1
    sum

  /** Samples a direction into `to`: `u` chooses the lobe and the angle to its axis. */
  def sample(u: Float, v: Float, to: MutableVec3): Unit =
    val k = chosen(u)
    val part = within(u, k)
    val kappa = kappas(k)
    val least = exp(-2f * kappa)
    val inverse = Math.log(part + (1f - part) * least + Tiny).toFloat / kappa
    val cos = Math.max(-1f, Math.min(1f + inverse, 1f))
    val sin = sqrt(1f - cos * cos)
    to.set(frame(k).toWorld(Warp.around(cos, sin, v)))

private[guiding] object Lobe:
  /** Keeps the logarithm finite. */
  inline val Tiny = 1e-20f

  /** Normalises a lobe of concentration `kappa` whose largest value is one. */
  def factor(kappa: Float): Float =
    (kappa / (2.0 * Math.PI * (1.0 - Math.exp(-2.0 * kappa)))).toFloat

  /** The power of e, for x ≤ 0, to five digits: Taylor's series around the nearest power of two. */
  def exp(x: Float): Float =
    if !(x > -80f) then 0f
    else
      val t = x * 1.442695f
      val whole = (t - 0.5f).toInt
      val f = (t - whole) * 0.6931472f
      val series = 1f + f * (1f + f * (0.5f + f * (0.16666667f + f * (0.041666668f +
        f * 0.008333334f))))
      series * java.lang.Float.intBitsToFloat((whole + 127) << 23)

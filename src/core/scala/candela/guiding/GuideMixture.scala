package candela.guiding

import candela.geometry.Frame
import candela.math.*
import candela.sampling.Warp

/** The mixture of a region as seen from one point. Mutable, one per worker. */
final class GuideMixture:
  import GuideField.*
  import Lobe.*
  private val xs, ys, zs, kappas, factors, ends = new Array[Float](Lobes)
  private var count = 0

  private val place = new Array[Float](3)

  /** The region of a point of this side ([[GuideField.side]]). */
  def region(field: GuideField, p: Vec3, side: Int): Int =
    place(0) = p.x
    place(1) = p.y
    place(2) = p.z
    field.region(side, place, 0)

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
      val s = 1f / Math.max(sqrt(x * x + y * y + z * z), 1e-12f)
      xs(k) = x * s
      ys(k) = y * s
      zs(k) = z * s
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

  /** Samples a direction into `to`. Each lobe is a strip of the square, so that evenly spread
    * points give evenly spread directions: `u` chooses it and the angle to its axis.
    */
  def sample(u: Float, v: Float, to: MutableVec3): Unit =
    var k = 0
    while k < count - 1 && u >= ends(k) do k += 1
    val begin = if k == 0 then 0f else ends(k - 1)
    val within = Math.max(0f, Math.min((u - begin) / (ends(k) - begin), 1f))
    val kappa = kappas(k)
    val least = exp(-2f * kappa)
    val inverse = Math.log(within + (1f - within) * least + Tiny).toFloat / kappa
    val cos = Math.max(-1f, Math.min(1f + inverse, 1f))
    val sin = sqrt(1f - cos * cos)
    val frame = Frame.around(Vec3(xs(k), ys(k), zs(k)))
    to.set(frame.toWorld(Warp.around(cos, sin, v)))

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

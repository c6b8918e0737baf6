package candela.guiding

import candela.geometry.Frame
import candela.math.*
import candela.sampling.Warp

/** The mixture of a region as seen from one point: lobes around directions, which are sampled by
  * their weights. Mutable, one per worker.
  */
final class GuideMixture:
  import GuideField.*
  import Lobe.*
  private val xs, ys, zs, factors, ends, kappas = new Array[Float](Lobes)
  private var count = 0
  private val position = new Array[Float](3)

  /** The region of a point of this side ([[GuideField.side]]). */
  def region(field: GuideField, p: Vec3, side: Int): Int =
    position(0) = p.x
    position(1) = p.y
    position(2) = p.z
    field.region(side, position, 0)

  /** Takes the mixture of the region, as seen from `p`. */
  def locate(field: GuideField, region: Int, p: Vec3): Unit =
    val cx = field.centres(3 * region) - p.x
    val cy = field.centres(3 * region + 1) - p.y
    val cz = field.centres(3 * region + 2) - p.z
    val lobes = field.lobes
    count = field.lobeCounts(region)
    var lobe = region * Lobes * Size
    var k = 0
    while k < count do
      val nearness = lobes(lobe + Nearness)
      val x = lobes(lobe) + cx * nearness
      val y = lobes(lobe + 1) + cy * nearness
      val z = lobes(lobe + 2) + cz * nearness
      turn(k, x, y, z)
      kappas(k) = lobes(lobe + Kappa)
      ends(k) = lobes(lobe + End)
      factors(k) = lobes(lobe + Factor)
      lobe += Size
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
    val fraction = stripPosition(u, k)
    val kappa = kappas(k)
    val minimum = exp(-2f * kappa)
    val inverse = Math.log(fraction + (1f - fraction) * minimum + Tiny).toFloat / kappa
    val cos = Math.max(-1f, Math.min(1f + inverse, 1f))
    val sin = sqrt(1f - cos * cos)
    to.set(frame(k).toWorld(Warp.spherical(cos, sin, v)))

  /** Sets the axis of a lobe to this direction, of any length. */
  private def turn(k: Int, x: Float, y: Float, z: Float): Unit =
    val s = 1f / Math.max(sqrt(x * x + y * y + z * z), 1e-12f)
    xs(k) = x * s
    ys(k) = y * s
    zs(k) = z * s

  /** The lobe that `u` chooses. Each is a strip of the square, so that evenly spread points give
    * evenly spread directions.
    */
  private def chosen(u: Float): Int =
    var k = 0
    while k < count - 1 && u >= ends(k) do k += 1
    k

  /** Where `u` lies in the strip of the lobe, from 0 to 1. */
  private def stripPosition(u: Float, k: Int): Float =
    val start = if k == 0 then 0f else ends(k - 1)
    Math.max(0f, Math.min((u - start) / (ends(k) - start), 1f))

  private def frame(k: Int): Frame = Frame.fromZ(Vec3(xs(k), ys(k), zs(k)))

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
      val exponent = (t - 0.5f).toInt
      val f = (t - exponent) * 0.6931472f
      val series = 1f + f * (1f + f * (0.5f + f * (0.16666667f + f * (0.041666668f +
        f * 0.008333334f))))
      series * java.lang.Float.intBitsToFloat((exponent + 127) << 23)

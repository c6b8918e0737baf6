package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Checkerboard of `even` and `odd` squares or cubes. */
final class CheckerboardFloat(checks: Checks, even: FloatTexture, odd: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val share = checks.oddShare(at)
    if share <= 0f || (even eq odd) then even(at)
    else if share >= 1f then odd(at)
    else lerp(share, even(at), odd(at))

/** Checkerboard of `even` and `odd` squares or cubes. */
final class CheckerboardRgb(checks: Checks, even: RgbTexture, odd: RgbTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val share = checks.oddShare(at)
    if share <= 0f || (even eq odd) then even(at)
    else if share >= 1f then odd(at)
    else even(at) * (1f - share) + odd(at) * share

  override def maximum: Rgb = even.maximum.atLeast(odd.maximum)

/** Layout of a checkerboard; the check from the origin to (1, 1, …) is even. */
abstract class Checks:

  /** Fraction of the footprint of `at` covered by odd checks, in [0, 1].
    *
    * Checks are separable: with c = 1 where the integer part of x is even and −1 where it is odd,
    * the sign at (s, t) is c(s)·c(t). The same holds for filtered signs if the filter is separable.
    */
  def oddShare(at: ShadingPoint): Float

final class Squares(mapping: Mapping2D, filter: CheckFilter) extends Checks:
  def oddShare(at: ShadingPoint): Float =
    val c = mapping(at)
    val f = mapping.footprint(at)
    val ds = Math.max(abs(f.dsdx), abs(f.dsdy))
    val dt = Math.max(abs(f.dtdx), abs(f.dtdy))
    (0.5 - 0.5 * filter.sign(c.s, ds) * filter.sign(c.t, dt)).toFloat

final class Cubes(mapping: Mapping3D, filter: CheckFilter) extends Checks:
  def oddShare(at: ShadingPoint): Float =
    val p = mapping(at)
    val r = mapping.extent(at)
    (0.5 - 0.5 * filter.sign(p.x, r.x) * filter.sign(p.y, r.y) * filter.sign(p.z, r.z)).toFloat

/** Filters the sign c of [[Checks]]. */
enum CheckFilter:

  /** Point sampling: only the pixel's samples antialias edges. */
  case Point

  /** Box filter from x − r to x + r; 0 if it spans more than two checks (pbrt-v2 and v3). */
  case Box

  /** Triangle filter from x − 1.5 r to x + 1.5 r (pbrt-v4). */
  case Triangle

  /** @param r largest step to a neighbouring raster position, in checks; 0 if unknown */
  def sign(x: Float, r: Float): Double = this match
    case Point => CheckFilter.sign(x)
    case Box =>
      if r > 1f then 0.0
      else if CheckFilter.isInside(x, r) then CheckFilter.sign(x)
      else (CheckFilter.integral(x.toDouble + r) - CheckFilter.integral(x.toDouble - r)) / (2.0 * r)
    case Triangle =>
      val w = 1.5 * r
      if CheckFilter.isInside(x, w) then CheckFilter.sign(x)
      else
        val sides = CheckFilter.integral2(x + w) + CheckFilter.integral2(x - w)
        (sides - 2.0 * CheckFilter.integral2(x)) / (w * w)

object CheckFilter:
  private def isInside(x: Double, r: Double) = Math.floor(x - r) == Math.floor(x + r)

  private def sign(x: Double): Double = if (Math.floor(x).toLong & 1) == 0 then 1.0 else -1.0

  /** Integral of the sign from 0 to x: a triangle wave between 0 and 1, of period 2. */
  private def integral(x: Double): Double =
    val y = x - 2.0 * Math.floor(0.5 * x)
    1.0 - Math.abs(1.0 - y)

  /** Integral of that wave less its mean 1/2, from 0 to x: also of period 2, so that nothing
    * cancels far from the origin. The mean has no second difference.
    */
  private def integral2(x: Double): Double =
    val fraction = x - Math.floor(x)
    -0.5 * sign(x) * fraction * (1.0 - fraction)

package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Squares or cubes of `even` and `odd` in turn. */
final class CheckerboardFloat(checks: Checks, even: FloatTexture, odd: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val share = checks.oddShare(at)
    if share <= 0f then even(at)
    else if share >= 1f then odd(at)
    else lerp(share, even(at), odd(at))

/** Squares or cubes of `even` and `odd` in turn. */
final class CheckerboardRgb(checks: Checks, even: RgbTexture, odd: RgbTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val share = checks.oddShare(at)
    if share <= 0f then even(at)
    else if share >= 1f then odd(at)
    else even(at) * (1f - share) + odd(at) * share

/** Where the checks of a pattern are; the one from the origin to (1, 1, …) is even. */
abstract class Checks:

  /** The part of the footprint of `at` that is odd, between 0 and 1.
    *
    * Checks are a product: with c = 1 where the whole part of x is even and −1 where it is odd, the
    * sign at (s, t) is c(s)·c(t); so of filtered signs, if the filter is a product too.
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

/** Averages the sign c of [[Checks]] around a place. */
enum CheckFilter:

  /** The sign at the place itself: edges are smoothed by the pixel's samples alone. */
  case Point

  /** The mean from x − r to x + r; of more than two checks none is seen (pbrt-v2 and v3). */
  case Box

  /** Weighted by a triangle from x − 1.5 r to x + 1.5 r (pbrt-v4). */
  case Triangle

  /** @param r the largest step to a neighbour on the film, in checks; 0 if it is not known */
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

  /** From 0 to x of the sign: a wave between 0 and 1, of period 2. */
  private def integral(x: Double): Double =
    val y = x - 2.0 * Math.floor(0.5 * x)
    1.0 - Math.abs(1.0 - y)

  /** From 0 to x of that wave, less its mean ½: of period 2 too, so that nothing cancels far from
    * the origin. The mean has no second difference.
    */
  private def integral2(x: Double): Double =
    val part = x - Math.floor(x)
    -0.5 * sign(x) * part * (1.0 - part)

package candela.film

import candela.base.loop
import candela.math.*

/** A reconstruction filter: filter weight at offset (`dx`, `dy`) from the pixel centre. Zero
  * outside the radii; need not be normalised, may be negative.
  *
  * All filters here are separable, and so cheap to tabulate and to sample; see [[FilterSampler]].
  */
abstract class Filter(val radiusX: Float, val radiusY: Float):
  require(radiusX > 0f && radiusY > 0f, s"filter radii must be positive, found $radiusX, $radiusY")

  def x(dx: Float): Float
  def y(dy: Float): Float
  final def apply(dx: Float, dy: Float): Float = x(dx) * y(dy)

  /** Integral over its extent, by the midpoint rule along both axes. */
  final def integral: Double = Filter.along(radiusX, x) * Filter.along(radiusY, y)

  /** How alike pixels are that share samples: the sum of a pixel's correlations with all pixels,
    * its own 1 included. All that a sample counts is ∫f of the filter f, and the variance of one
    * pixel has ∫f² of it.
    */
  final def correlation: Double =
    def along(radius: Float, value: Float => Float) =
      val area = Filter.along(radius, value)
      area * area / Filter.along(radius, d => value(d) * value(d))
    along(radiusX, x) * along(radiusY, y)

private object Filter:
  private val Steps = 4096

  def along(radius: Float, value: Float => Float): Double =
    var sum = 0.0
    loop(Steps)(i => sum += value(((2.0 * i + 1) / Steps - 1).toFloat * radius))
    sum * 2 * radius / Steps

// Scene files name the radii `xwidth`, `ywidth` (pbrt-v2, v3) or `xradius`, `yradius` (v4); all in
// pixels from the centre. The defaults are given as v2 and v3 / v4.

/** Box filter: constant weight. Defaults: radii 0.5 / 0.5. */
final class BoxFilter(radiusX: Float, radiusY: Float) extends Filter(radiusX, radiusY):
  def x(dx: Float): Float = if abs(dx) <= radiusX then 1f else 0f
  def y(dy: Float): Float = if abs(dy) <= radiusY then 1f else 0f

/** Triangle (tent) filter. Defaults: radii 2 / 2. */
final class TriangleFilter(radiusX: Float, radiusY: Float) extends Filter(radiusX, radiusY):
  def x(dx: Float): Float = Math.max(0f, radiusX - abs(dx))
  def y(dy: Float): Float = Math.max(0f, radiusY - abs(dy))

/** exp(−α d²), shifted to reach 0 at the radius.
  *
  * @param alpha in pixels⁻², positive
  */
final class GaussianFilter private (radiusX: Float, radiusY: Float, alpha: Double)
    extends Filter(radiusX, radiusY):
  require(alpha > 0, s"`alpha` must be positive, found $alpha")

  private val edgeX = Math.exp(-alpha * radiusX * radiusX)
  private val edgeY = Math.exp(-alpha * radiusY * radiusY)

  def x(dx: Float): Float = lowered(dx, edgeX)
  def y(dy: Float): Float = lowered(dy, edgeY)

  private def lowered(d: Float, edge: Double): Float =
    Math.max(0.0, Math.exp(-alpha * d * d) - edge).toFloat

object GaussianFilter:
  /** As in pbrt-v2 and v3. Defaults: radii 2, alpha 2. */
  def ofAlpha(radiusX: Float, radiusY: Float, alpha: Float): GaussianFilter =
    GaussianFilter(radiusX, radiusY, alpha.toDouble)

  /** As in pbrt-v4: `sigma` is the standard deviation in pixels. Defaults: radii 1.5, sigma 0.5,
    * which is alpha 2.
    */
  def ofSigma(radiusX: Float, radiusY: Float, sigma: Float): GaussianFilter =
    GaussianFilter(radiusX, radiusY, 1 / (2.0 * sigma * sigma))

/** Mitchell–Netravali filter: two cubic pieces on each side, the outer one negative; sharp, with
  * little ringing. Integrates to 1 for every `b` and `c` at radius 2. Defaults: radii 2 / 2, B = C
  * = 1/3.
  *
  * Source: Mitchell & Netravali, "Reconstruction filters in computer graphics", SIGGRAPH 1988, eq.
  * 8.
  */
final class MitchellFilter(radiusX: Float, radiusY: Float, b: Float, c: Float)
    extends Filter(radiusX, radiusY):
  def x(dx: Float): Float = cubic(2f * dx / radiusX)
  def y(dy: Float): Float = cubic(2f * dy / radiusY)

  private def cubic(at: Float): Float =
    val t = abs(at)
    val sixfold =
      if t < 1f then ((12f - 9f * b - 6f * c) * t - 18f + 12f * b + 6f * c) * t * t + 6f - 2f * b
      else if t < 2f then
        ((-b - 6f * c) * t + 6f * b + 30f * c) * t * t - (12f * b + 48f * c) * t + 8f * b + 24f * c
      else 0f
    sixfold * (1f / 6f)

/** Lanczos-windowed sinc: a sinc times the central lobe of a wider sinc, truncated at the radius.
  *
  * @param frequency of the sinc: zeros at the multiples of 1/frequency pixels
  * @param window    frequency of the windowing sinc
  */
final class LanczosSincFilter private (
    radiusX: Float,
    radiusY: Float,
    frequencyX: Double,
    frequencyY: Double,
    windowX: Double,
    windowY: Double
) extends Filter(radiusX, radiusY):
  def x(dx: Float): Float = windowed(dx, radiusX, frequencyX, windowX)
  def y(dy: Float): Float = windowed(dy, radiusY, frequencyY, windowY)

  private def windowed(d: Float, radius: Float, frequency: Double, window: Double): Float =
    if abs(d) > radius then 0f else (sinc(d * frequency) * sinc(d * window)).toFloat

  private def sinc(x: Double): Double =
    // Below this the quotient differs from 1 by less than Double precision.
    if Math.abs(x) < 1e-9 then 1.0 else Math.sin(Math.PI * x) / (Math.PI * x)

object LanczosSincFilter:
  /** As in pbrt-v3 and v4: one lobe per pixel, a window of `tau` pixels. Defaults: radii 4, tau 3.
    */
  def apply(radiusX: Float, radiusY: Float, tau: Float): LanczosSincFilter =
    require(tau > 0f, s"`tau` must be positive, found $tau")
    new LanczosSincFilter(radiusX, radiusY, 1, 1, 1.0 / tau, 1.0 / tau)

  /** As in pbrt-v2: the window ends at the radius, with `tau` lobes inside. Defaults: radii 4,
    * tau 3.
    */
  def stretched(radiusX: Float, radiusY: Float, tau: Float): LanczosSincFilter =
    require(tau > 0f, s"`tau` must be positive, found $tau")
    val inverseX = 1.0 / radiusX
    val inverseY = 1.0 / radiusY
    new LanczosSincFilter(radiusX, radiusY, tau * inverseX, tau * inverseY, inverseX, inverseY)

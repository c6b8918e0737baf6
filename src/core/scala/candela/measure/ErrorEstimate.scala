package candela.measure

/** The error of an image of N samples per pixel, estimated from its own samples.
  *
  * The mean of n samples has the variance V(n). Its two halves have the means A and B, and the
  * scatter D(n), the mean of (A − B)² / 4, has the expectation V(n/2) − V(n).
  *
  * Parts of V(n) fall as fast as 1 / n³, for smooth integrands and scrambled nets (Owen, "Scrambled
  * net variance for integrals of smooth functions", Annals of Statistics 25(4), 1997), and others
  * as 1 / n, as of independent samples. With V(n) = a / n + b / n³, two scatters give V(N) = D(N) −
  * (D(N/2) − 2 D(N)) / 7. Rates in between leave less, as V(N) is a convex function of the decay
  * D(N/2) / D(N): for a single rate D(N) / (decay − 1).
  *
  * @param samples  N
  * @param absolute D(N), as [[Metrics.mse]] is
  * @param relative D(N), as [[Metrics.relativeMse]] is
  * @param lowest   the same, relative to the pixel's own value where that is above the local mean:
  *   as if bright pixels were truly bright, not by chance
  * @param decay    of the relative D(N), from 2 to 8
  * @param pixels   effective number of pixels that have the error: (ΣR)² / ΣR², for the relative
  *   scatter R of each
  */
final case class ErrorEstimate private (
    samples: Int,
    absolute: Double,
    relative: Double,
    lowest: Double,
    decay: Double,
    pixels: Double
):
  import ErrorEstimate.{Independent, Smooth}

  /** V(N) / D(N). */
  val factor: Double = 1 - (decay - Independent) / (Smooth - 1)

  /** The part of V(N) that falls as 1 / n³. */
  private val smooth = (decay - Independent) / ((Smooth - Independent) * (Smooth - 1) * factor)

  /** V(n) / V(N). The part b / n³ falls at powers of two only: in between, further points balance
    * none but each other, as if independent.
    */
  def falloff(n: Double): Double =
    val doubled = Math.scalb(1.0, Math.max(0, Math.getExponent(n / samples)))
    (1 - smooth + smooth / (doubled * doubled)) * samples / n

  def at(n: Double): Errors =
    val scale = factor * falloff(n)
    Errors(absolute * scale, relative * scale, None, None, None, Vector.empty)

  /** The relative MSE of n samples per pixel with its 95 % interval, from V(N) = D(N), where all
    * falls as 1 / n, down to V(N) = D(N) / 3, where all falls as 1 / n²: variances of whole pixels
    * fall no faster (Mitchell, "Consequences of Stratified Sampling in Graphics", SIGGRAPH 1996).
    *
    * The square of a normal value has the relative variance 2, and the mean square 3. So the
    * logarithm of a sum of squares over these pixels has the variance 2 / (3 pixels), and both the
    * scatter and the true error are such sums.
    */
  def interval(n: Double): Interval =
    val intervalFactor = Math.exp(1.959964 * Math.sqrt(4 / (3 * pixels)))
    val estimate = relative * factor
    Interval(
      estimate,
      Math.min(estimate, lowest / 3) / intervalFactor,
      relative * intervalFactor
    ) * falloff(n)

  /** Samples per pixel with which the relative MSE is at most this, with the 95 % interval. */
  def samplesUntil(relativeMse: Double): Interval =
    val ratio = interval(samples) * (1 / relativeMse)
    var doubled = samples.toDouble
    while ratio.estimate * falloff(2 * doubled) > 1 && doubled < Int.MaxValue do doubled *= 2
    val end = doubled * Math.max(1, Math.min(2, ratio.estimate * falloff(doubled)))
    val first = samples * Math.sqrt(Math.max(1, ratio.low))
    Interval(end, Math.min(end, first), samples * Math.max(1, ratio.high))

object ErrorEstimate:
  // D(n/2) / D(n), where V(n) falls as 1 / n, and as 1 / n³
  private val Independent = 2.0
  private val Smooth = 8.0

  /** @param decay D(N/2) / D(N), if both are known */
  def apply(
      samples: Int,
      absolute: Double,
      relative: Double,
      lowest: Double,
      decay: Option[Double],
      pixels: Double
  ): ErrorEstimate =
    val bounded = decay.fold(Independent)(d => Math.max(Independent, Math.min(Smooth, d)))
    new ErrorEstimate(samples, absolute, relative, lowest, bounded, pixels)

package candela.measure

/** The error of an image of N samples per pixel, estimated from its own samples.
  *
  * The mean of n samples has the variance V(n). Its two halves have the means A and B, and the
  * scatter D, the mean of (A − B)² / 4, has the expectation V(N/2) − V(N). That is V(N) for
  * independent samples, and more where variance falls faster than 1 / n, as with low-discrepancy
  * points: the estimate errs upwards.
  *
  * @param samples  N
  * @param absolute D, as [[Metrics.mse]] is
  * @param relative D, as [[Metrics.relativeMse]] is
  * @param lowest   the same, relative to the pixel's own value where that is above the local mean:
  *   as if bright pixels were truly bright, not by chance
  * @param pixels   effective number of pixels that have the error: (ΣR)² / ΣR², for the relative
  *   scatter R of each
  */
final case class ErrorEstimate(
    samples: Int,
    absolute: Double,
    relative: Double,
    lowest: Double,
    pixels: Double
):
  def at(n: Double): Errors =
    val scale = samples / n
    Errors(absolute * scale, relative * scale, None, None, None, Vector.empty)

  /** The relative MSE of n samples per pixel with its 95 % interval, from V(N) = D, where all falls
    * as 1 / n, down to V(N) = D / 3, where all falls as 1 / n²: variances of whole pixels fall no
    * faster (Mitchell, "Consequences of Stratified Sampling in Graphics", SIGGRAPH 1996).
    *
    * The square of a normal value has the relative variance 2, and the mean square 3. So the
    * logarithm of a sum of squares over these pixels has the variance 2 / (3 pixels), and both the
    * scatter and the true error are such sums.
    */
  def interval(n: Double): Interval =
    val intervalFactor = Math.exp(1.959964 * Math.sqrt(4 / (3 * pixels)))
    Interval(relative, lowest / 3 / intervalFactor, relative * intervalFactor) * (samples / n)

  /** Samples per pixel with which the relative MSE is at most this, with the 95 % interval. */
  def samplesUntil(relativeMse: Double): Interval =
    val ratio = interval(samples) * (1 / relativeMse)
    Interval(
      samples * Math.max(1, ratio.estimate),
      samples * Math.sqrt(Math.max(1, ratio.low)),
      samples * Math.max(1, ratio.high)
    )

package candela.measure

import candela.base.loop
import candela.image.Image

/** Error of an image, as far as known.
  *
  * @param flip mean FLIP error, if there is a reference
  * @param meanRatio mean over the reference's mean, per channel; empty without a reference
  */
final case class Errors(
    mse: Double,
    relativeMse: Double,
    mae: Option[Double],
    psnr: Option[Double],
    flip: Option[Double],
    meanRatio: Vector[Double]
):
  def apply(metric: Metric): Option[Double] = metric match
    case Metric.Mse => Some(mse)
    case Metric.Rmse => Some(Math.sqrt(mse))
    case Metric.RelativeMse => Some(relativeMse)
    case Metric.Mae => mae
    case Metric.Psnr => psnr
    case Metric.Flip => flip

object Errors:

  /** Error against a reference. */
  def against(reference: Image)(image: Image): Errors =
    val pair = ImagePair(image, reference)
    val flip = Option.when(pair.isColor)(ErrorMap.mean(ErrorMap(Metric.Flip, pair)))
    quickly(reference)(image).copy(flip = flip)

  /** Error against a reference, without FLIP, which takes by far the longest. */
  def quickly(reference: Image)(image: Image): Errors =
    val m = Metrics.compare(image, reference)
    Errors(m.mse, m.relativeMse, Some(m.mae), Some(m.psnr), None, m.meanRatio)

  /** Error estimated from the rendering alone, by the difference of two subsets of its samples.
    *
    * If the images A of m samples and B of the other n − m are independent, each with variance σ²
    * per sample, the expectation of (A − B)² is σ² n / (m (n − m)). The variance of their combined
    * image is σ² / n, which is m (n − m) / n² of that. Low-discrepancy samples make A and B
    * complement each other, so this overestimates the error. It excludes bias.
    */
  def ofParts(first: Image, firstSamples: Int, second: Image, secondSamples: Int): Errors =
    val total = (firstSamples + secondSamples).toDouble
    val share = firstSamples / total * (secondSamples / total)
    var squares, relatives = 0.0
    loop(first.data.length): i =>
      val (a, b) = (first.data(i).toDouble, second.data(i).toDouble)
      val square = (a - b) * (a - b) * share
      val mean = (a * firstSamples + b * secondSamples) / total + Metrics.RelativeEpsilon
      squares += square
      relatives += square / (mean * mean)
    val count = first.data.length
    Errors(squares / count, relatives / count, None, None, None, Vector.empty)

/** Point of an error curve. */
final case class CurvePoint(samples: Int, seconds: Double, errors: Errors)

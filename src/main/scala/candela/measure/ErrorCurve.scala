package candela.measure

import candela.base.loop
import candela.image.Image

/** How wrong an image is, as far as it is known.
  *
  * @param flip      if there is a reference to look at
  * @param meanRatio of each channel; empty without a reference
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

  /** Against a reference. */
  def against(reference: Image)(image: Image): Errors =
    val pair = ImagePair(image, reference)
    val m = Metrics.compare(image, reference)
    val flip = Option.when(pair.isColor)(ErrorMap.mean(ErrorMap(Metric.Flip, pair)))
    Errors(m.mse, m.relativeMse, Some(m.mae), Some(m.psnr), flip, m.meanRatio)

  /** From the rendering alone: how much two parts of its samples differ.
    *
    * If the images A of m samples and B of n − m others are independent, each of variance σ² for a
    * sample, then (A − B)² is σ² n / (m (n − m)) on average, while their common image has the
    * variance σ² / n: that is m (n − m) / n² of it. Points that are spread evenly make A and B
    * complement each other: then this is more than the true error. Bias is not in it at all.
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

/** One point of a curve of error over time. */
final case class CurvePoint(samples: Int, seconds: Double, errors: Errors)

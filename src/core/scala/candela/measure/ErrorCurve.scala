package candela.measure

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

/** Point of an error curve. */
final case class CurvePoint(samples: Int, seconds: Double, errors: Errors)

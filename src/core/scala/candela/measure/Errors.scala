package candela.measure

import candela.image.Image

/** Error of an image, as far as known.
  *
  * @param flip mean FLIP error, if there is a reference
  * @param meanRatio mean over the reference's mean, per channel; empty without a reference
  * @param own the error of the reference itself, which is subtracted from `mse` and `relativeMse`;
  *   if it is all of them, they are 0
  */
final case class Errors(
    mse: Double,
    relativeMse: Double,
    mae: Option[Double],
    psnr: Option[Double],
    flip: Option[Double],
    meanRatio: Vector[Double],
    own: Option[OwnError] = None
):
  /** Whether the error is too small for the reference to tell. */
  def isUnresolved: Boolean = own.isDefined && relativeMse == 0

  def apply(metric: Metric): Option[Double] = metric match
    case Metric.Mse => Some(mse)
    case Metric.Rmse => Some(Math.sqrt(mse))
    case Metric.RelativeMse => Some(relativeMse)
    case Metric.Mae => mae
    case Metric.Psnr => psnr
    case Metric.Flip => flip

object Errors:

  /** Error against a reference, which may have an [[ErrorLayer]]. */
  def against(reference: Image)(image: Image): Errors =
    val pair = ImagePair(image, reference)
    val flip = Option.when(pair.isColor)(Flip.mean(pair))
    quickly(reference)(image).copy(flip = flip)

  /** Error against a reference, without FLIP, which takes by far the longest. */
  def quickly(reference: Image)(image: Image): Errors =
    val m = Metrics.compare(image, reference)
    val referenceError = ErrorLayer.error(reference)
    val mse = m.mse - referenceError.fold(0.0)(_.mse)
    val relativeMse = m.relativeMse - referenceError.fold(0.0)(_.relativeMse)
    Errors(
      Math.max(0, mse),
      Math.max(0, relativeMse),
      Some(m.mae),
      Some(m.psnr),
      None,
      m.meanRatio,
      referenceError
    )

/** Point of an error curve.
  *
  * @param interval 95 % interval of the relative MSE, where that is an estimate
  */
final case class CurvePoint(
    samples: Int,
    seconds: Double,
    errors: Errors,
    interval: Option[Interval] = None
)

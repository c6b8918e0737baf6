package candela.cli

import candela.measure.{Metric, PixelWindow}

/** What `compare` is asked for beside the pictures.
  *
  * @param channels   to compare, instead of R, G and B (or all, if a picture has no colours)
  * @param difference where to write |a − b|
  * @param heatMap    where to write the error of each pixel, as colours
  * @param heatMapMax the error that gets the brightest colour
  * @param limits     above which (PSNR: below which) the comparison fails
  */
final case class CompareOptions(
    crop: Option[PixelWindow] = None,
    channels: Option[Vector[String]] = None,
    perChannel: Boolean = false,
    difference: Option[String] = None,
    heatMap: Option[String] = None,
    heatMapMetric: Metric = Metric.Flip,
    heatMapMax: Option[Double] = None,
    limits: Vector[Limit] = Vector.empty
):
  /** FLIP takes longer than all other figures together. */
  def writesPictures: Boolean = difference.isDefined || heatMap.isDefined

/** What a comparison must not exceed.
  *
  * @param option as on the command line, without dashes
  * @param figure in words
  */
final case class Limit(option: String, figure: String, value: Double):

  /** What is wrong, if something is; a figure that isn't known is. */
  def broken(c: Comparison): Option[String] = option match
    case "min-psnr" => Option.unless(c.metrics.psnr >= value)(said(c.metrics.psnr, "below"))
    case other =>
      val found = Limit.figures(other)(c)
      Option.unless(found.exists(_ <= value)):
        found.fold(s"there is no $figure of these pictures")(said(_, "above"))

  private def said(found: Double, where: String): String =
    s"$figure ${Figures.scientific(found)} is $where --$option $value"

object Limit:
  private val figures: Map[String, Comparison => Option[Double]] = Map(
    "max-mse" -> (c => Some(c.metrics.mse)),
    "max-rmse" -> (c => Some(c.metrics.rmse)),
    "max-mae" -> (c => Some(c.metrics.mae)),
    "max-relmse" -> (c => Some(c.metrics.relativeMse)),
    "max-bias" -> (c => Some(c.metrics.bias)),
    "max-flip" -> (c => c.flip)
  )

  /** Option, figure, and the text of its help. */
  val all: Vector[(String, String, String)] = Vector(
    ("max-mse", "MSE", "the mean squared error"),
    ("max-rmse", "RMSE", "its root"),
    ("max-mae", "MAE", "the mean absolute error"),
    ("max-relmse", "relative MSE", "the relative mean squared error"),
    ("max-flip", "FLIP", "the mean of FLIP"),
    ("max-bias", "bias", "the largest |mean ratio − 1| of a channel"),
    ("min-psnr", "PSNR", "the peak signal-to-noise ratio in dB")
  )

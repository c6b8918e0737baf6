package candela.bench.statistics

import candela.base.loop
import candela.image.Image
import candela.measure.{ImagePair, Metric, Metrics}

/** The squared error of an image, taken apart: by place and by spatial frequency.
  *
  * @param squared of each square of 8 × 8 pixels, its share in the MSE: their sum is the MSE
  * @param relative the same of the relative MSE
  * @param worst share of the worst hundredth of pixels in the relative MSE
  * @param spectrum of the relative error
  */
final case class ErrorParts(
    squared: Array[Double],
    relative: Array[Double],
    worst: Double,
    spectrum: ErrorSpectrum
):
  def apply(metric: Metric): Option[Array[Double]] = metric match
    case Metric.Mse => Some(squared)
    case Metric.RelativeMse => Some(relative)
    case _ => None

object ErrorParts:
  /** Width and height of a part, in pixels: wider than what a pixel's filter shares with others. */
  val Size = 8

  /** Error against a reference of the same size and channels. */
  def against(pair: ImagePair): ErrorParts = of(pair.image, pair.reference, pair.reference, 1)

  /** @param image  three channels, like the others
    * @param center what it should be
    * @param scale  what its errors are relative to
    * @param factor of all squared errors
    */
  private[statistics] def of(
      image: Image,
      center: Image,
      scale: Image,
      factor: Double
  ): ErrorParts =
    val (width, height, channels) = (image.width, image.height, image.channels)
    val columns = (width + Size - 1) / Size
    val squared, relative = new Array[Double](columns * ((height + Size - 1) / Size))
    val pixels = new Array[Double](width * height)
    val planes = Vector.fill(channels)(new Array[Double](width * height))
    def isFinite(a: Image, pixel: Int) =
      (0 until channels).forall(c => java.lang.Float.isFinite(a.data(channels * pixel + c)))
    var count = 0
    loop(width * height): pixel =>
      if isFinite(image, pixel) && isFinite(center, pixel) && isFinite(scale, pixel) then
        count += 1
        val tile = pixel / width / Size * columns + pixel % width / Size
        loop(channels): c =>
          val index = channels * pixel + c
          val difference = image.data(index).toDouble - center.data(index)
          val ratio = difference / (scale.data(index) + Metrics.RelativeEpsilon)
          val error = if java.lang.Double.isFinite(ratio) then ratio else 0
          squared(tile) += difference * difference
          relative(tile) += error * error
          pixels(pixel) += error * error
          planes(c)(pixel) = error
    val share = factor / (Math.max(count, 1) * channels)
    val spectrum =
      ErrorSpectrum.of(planes, width, height) * (factor * width * height / Math.max(count, 1))
    ErrorParts(squared.map(_ * share), relative.map(_ * share), worstOf(pixels), spectrum)

  private def worstOf(pixels: Array[Double]): Double =
    val sorted = pixels.sorted
    val total = sorted.sum
    val hundredth = (sorted.length + 99) / 100
    if total > 0 then sorted.drop(sorted.length - hundredth).sum / total else 0

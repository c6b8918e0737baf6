package candela.measure

import candela.base.loop
import candela.image.Image

/** The mean of independent renderings of one scene, and the variance of its values, which is its
  * expected squared error.
  *
  * What a file holds of it is its whole state: a reference that goes on from its file is the one
  * that was never interrupted, bit for bit.
  *
  * @param runs     renderings so far
  * @param variance of each value; none before the second
  */
final class ReferenceMean private (val runs: Int, val image: Image, val variance: Option[Image]):

  /** With another rendering (Welford, "Note on a method for calculating corrected sums of squares
    * and products", Technometrics 4, 1962).
    */
  def and(next: Image): ReferenceMean =
    require(next.width == image.width && next.height == image.height)
    val n = runs + 1.0
    val mean, spread = new Array[Float](image.data.length)
    loop(mean.length): i =>
      val oldMean = image.data(i).toDouble
      val step = next.data(i) - oldMean
      mean(i) = (oldMean + step / n).toFloat
      val squares = variance.fold(0.0)(_.data(i) * (runs * (runs - 1.0)))
      spread(i) = ((squares + step * (next.data(i) - mean(i))) / (n * (n - 1))).toFloat
    ReferenceMean(runs + 1, imageOf(mean), Some(imageOf(spread)))

  private def imageOf(data: Array[Float]) = Image(image.width, image.height, Image.RgbNames, data)

  /** Its relative error, as `--error` has it: the root of the expected relative MSE. */
  def relativeError: Option[Double] = variance.map: v =>
    Math.sqrt(LocalMeans(image, v.data).relativeMse)

  /** The image with its [[ErrorLayer]]. */
  def stored: Image = variance.fold(image)(ErrorLayer.append(image, _))

object ReferenceMean:
  def of(first: Image): ReferenceMean = ReferenceMean(1, first.toRgb, None)

  /** The one that a file holds; none if it holds none. */
  def of(stored: Image, runs: Int): Option[ReferenceMean] =
    val variance = ErrorLayer.of(stored)
    val isWhole = stored.indicesOf(Image.RgbNames).isDefined &&
      (if runs == 1 then variance.isEmpty else runs > 1 && variance.isDefined)
    Option.when(isWhole)(ReferenceMean(runs, stored.toRgb, variance))

package candela.render

import candela.image.Image
import candela.measure.{BiasTest, Renderings, TileSums}

import org.apache.commons.statistics.distribution.TDistribution

/** How a part of an image differs from its reference, beyond what noise explains.
  *
  * @param pValue chance that noise alone would differ at least so
  */
final case class Disagreement(what: String, pValue: Double)

/** Are independent renderings of one scene the same image as a reference, up to the noise of both?
  *
  * Two questions are asked, and each answer is a p-value:
  *  - of each channel of squares of 8 × 8 pixels up to the whole image: is the mean that of the
  *    reference? [[BiasTest]] asks it;
  *  - of the image: is the relative mean squared error what the noise predicts? This sees what
  *    cancels in the mean of a block, like an edge that is moved.
  *
  * The noise of the renderings is measured by their variance from each other in each pixel. That of
  * the reference is known as a mean over the image; a block of 8 × 8 pixels is given as much more
  * than that as its share in the noise of the renderings is above average, and never less.
  *
  * @param noise     variance of the reference's pixel values, mean over pixels and channels
  * @param allowance relative systematic error that is no fault
  * @param alike     sum of a pixel's correlations with all pixels of its rendering, its own 1
  *                  included: so much more variance a block has than its pixels
  */
final class Agreement(
    renders: Vector[Image],
    reference: Image,
    noise: Double,
    allowance: Double,
    alike: Double = 1
):
  require(renders.size >= 2, "noise shows only between renderings")
  require(renders.forall(r => r.width == reference.width && r.height == reference.height))

  private val width = reference.width
  private val height = reference.height
  private val count = renders.size
  private val values = 3 * width * height

  /** The pixel values in the order of [[Image.data]]; of the renderings their mean, and its
    * variance.
    */
  private val expected = reference.toRgb.data
  private val mean = new Array[Double](values)
  private val variance = new Array[Double](values)
  private val rendered = renders.map(_.toRgb.data)
  for i <- 0 until values do
    val samples = rendered.map(_(i).toDouble)
    mean(i) = samples.sum / count
    variance(i) = samples.map(s => Math.pow(s - mean(i), 2)).sum / (count - 1) / count

  private val meanVariance = variance.sum / values
  private val tolerated = allowance + Agreement.HalfRounding

  /** The renderings' mean. */
  def image: Image = Image(width, height, Image.RgbNames, mean.map(_.toFloat))

  /** The mean of the renderings minus the reference. */
  def difference: Image =
    Image(
      width,
      height,
      Image.RgbNames,
      Array.tabulate(values)(i => (mean(i) - expected(i)).toFloat)
    )

  /** What a chance of `significance`, for both questions together, does not explain; worst first,
    * of the means the worst of each size.
    */
  def disagreements(significance: Double): Vector[Disagreement] =
    (means :+ error).filter(_.pValue < significance / 2).sortBy(_.pValue)

  private def means: Vector[Disagreement] =
    val variances = filled(variance)
    val found = Renderings.withVariance(image, variances, count - 1.0, alike)
    val wanted =
      Renderings.withVariance(reference.toRgb, ofReference(variances), Agreement.KnownFreedom)
    BiasTest.of(found, wanted, tolerated).worst.map: r =>
      val w = r.window
      val place = s"x ${w.x0} to ${w.x1 - 1}, y ${w.y0} to ${w.y1 - 1}"
      val apart = 100 * (r.a / r.b - 1)
      val numbers = f"${r.a}%.5f, reference ${r.b}%.5f ($apart%+.2f %%, noise ${r.error}%.5f)"
      Disagreement(s"mean of ${r.channel} in $place: $numbers", r.adjusted)

  private def filled(data: Int => Double): Image =
    Image(width, height, Image.RgbNames, Array.tabulate(values)(data(_).toFloat))

  /** The variance of each value of the reference, by those of the renderings in its block. */
  private def ofReference(variances: Image): Image =
    val sums = TileSums.of(variances)
    def pixels(tile: Int, all: Int) = Math.min(TileSums.Size, all - tile * TileSums.Size)
    filled: i =>
      val column = i / 3 % width / TileSums.Size
      val row = i / 3 / width / TileSums.Size
      val sum = sums(row * sums.columns + column, i % 3)
      referenceVariance(sum / (pixels(column, width) * pixels(row, height)))

  /** Of a pixel of the reference, where those of the renderings have `local` on average. */
  private def referenceVariance(local: Double): Double =
    noise * Math.max(1.0, if meanVariance > 0 then local / meanVariance else 1.0)

  /** The relative mean squared error against its prediction. The excess of each pixel over it has a
    * mean of 0, so their sum is judged by their own spread; squares of errors are at most as
    * alike as the errors.
    */
  private def error: Disagreement =
    val found = new Array[Double](values)
    val predicted = new Array[Double](values)
    for i <- 0 until values do
      val scale = Math.pow(Math.max(expected(i), 0f) + Agreement.RelativeEpsilon, 2)
      found(i) = Math.pow(mean(i) - expected(i), 2) / scale
      val systematic = Math.pow(tolerated * expected(i), 2)
      predicted(i) = (variance(i) + referenceVariance(variance(i)) + systematic) / scale
    val excesses = Array.tabulate(width * height): pixel =>
      (3 * pixel until 3 * pixel + 3).map(i => found(i) - predicted(i)).sum
    val spread = Math.sqrt(alike * excesses.map(e => e * e).sum)
    val t = if spread > 0 then Math.max(0.0, excesses.sum / spread) else 0.0
    val p = 2 * TDistribution.of(excesses.length - 1.0).survivalProbability(t)
    val numbers = f"${found.sum / values}%.3g, predicted ${predicted.sum / values}%.3g (t = $t%.1f)"
    Disagreement(s"relative mean squared error: $numbers", p)

object Agreement:
  /** References are stored as half floats, whose 11 bits round by at most this part of the
    * value.
    */
  val HalfRounding: Double = 1.0 / (1 << 11)

  /** The same as in [[candela.measure.Metrics]]. */
  val RelativeEpsilon: Double = 0.01

  /** The noise of a reference is known, not estimated from few images. */
  private val KnownFreedom = 1e6

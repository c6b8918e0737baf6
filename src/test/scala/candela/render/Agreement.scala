package candela.render

import candela.film.PixelBounds
import candela.image.Image
import candela.testing.IncompleteGamma

/** How a part of an image differs from its reference, beyond what noise explains.
  *
  * @param pValue chance that noise alone would differ at least so
  */
final case class Disagreement(what: String, pValue: Double)

/** Are independent renderings of one scene the same image as a reference, up to the noise of both?
  *
  * Two questions are asked, and each answer is a p-value:
  *  - of each channel of each block of 8 × 8 and of 32 × 32 pixels, and of the whole image: is the
  *    mean that of the reference? A bias of a fraction of a percent shows in large blocks, and a
  *    wrong highlight or edge in small ones;
  *  - of the image: is the relative mean squared error what the noise predicts? This sees what
  *    cancels in the mean of a block, like an edge that is moved.
  *
  * The noise of the renderings is measured by their variance from each other in each pixel. A
  * block's mean then has Student's distribution, with the degrees of freedom of Welch and
  * Satterthwaite (few if a few pixels have most of the noise). The noise of the reference is known
  * as a mean over the image; a block is given as much more than that as its share in the noise of
  * the renderings is above average, and never less.
  *
  * @param noise     variance of the reference's pixel values, mean over pixels and channels
  * @param allowance relative systematic error that is no fault
  * @param alike     sum of a pixel's correlations with all pixels of its rendering, its own 1
  *                  included: so much more variance a block has than its pixels
  *
  * Sources: Welch, "The generalization of Student's problem", Biometrika 34, 1947; Satterthwaite,
  * "An approximate distribution of estimates of variance components", Biometrics Bulletin 2, 1946.
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

  /** What a chance of `significance`, for all questions together, does not explain; worst first. */
  def disagreements(significance: Double): Vector[Disagreement] =
    val all =
      Agreement.BlockSizes.flatMap(blockMeans) ++ blockMeans(Math.max(width, height)) :+ error
    // Šidák's correction for many questions
    val each = -Math.expm1(Math.log1p(-significance) / all.size)
    all.filter(_.pValue < each).sortBy(_.pValue)

  private def blockMeans(size: Int): Vector[Disagreement] =
    for block <- blocks(size); c <- Vector(0, 1, 2) yield blockMean(block, c)

  private def blocks(size: Int): Vector[PixelBounds] =
    (for y <- 0 until height by size; x <- 0 until width by size
    yield PixelBounds(x, y, Math.min(x + size, width), Math.min(y + size, height))).toVector

  private def indices(block: PixelBounds, channel: Int): IndexedSeq[Int] =
    for y <- block.y0 until block.y1; x <- block.x0 until block.x1
    yield 3 * (y * width + x) + channel

  private def blockMean(block: PixelBounds, channel: Int): Disagreement =
    val at = indices(block, channel)
    val n = at.size
    val wanted = at.map(expected(_).toDouble).sum / n
    val found = at.map(mean).sum / n
    val sum = at.map(variance).sum
    val total = alike * sum / n / n + referenceVariance(sum / n) / n
    val excess = Math.max(0.0, Math.abs(found - wanted) - tolerated * Math.abs(wanted))
    val t = if excess == 0 then 0.0 else excess / Math.sqrt(total)
    val p = Agreement.twoSided(t, freedom(sum, at.map(i => variance(i) * variance(i)).sum))
    val place = s"x ${block.x0} to ${block.x1 - 1}, y ${block.y0} to ${block.y1 - 1}"
    val numbers =
      f"$found%.5f, reference $wanted%.5f (${100 * (found / wanted - 1)}%+.2f %%, t = $t%.1f)"
    Disagreement(s"mean of ${"RGB" (channel)} in $place: $numbers", p)

  /** Of a pixel of the reference, where those of the renderings have `local` on average. */
  private def referenceVariance(local: Double): Double =
    noise * Math.max(1.0, if meanVariance > 0 then local / meanVariance else 1.0)

  /** Degrees of freedom of a sum of variances, each estimated with k = count − 1 of its own, from
    * their sum and the sum of their squares (which expects 1 + 2/k times the true squares).
    */
  private def freedom(sum: Double, squares: Double): Double =
    val k = count - 1.0
    if squares > 0 then Math.max(k, k * (1 + 2 / k) * sum * sum / squares / alike) else k

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
    val p = Agreement.twoSided(t, excesses.length - 1.0)
    val numbers = f"${found.sum / values}%.3g, predicted ${predicted.sum / values}%.3g (t = $t%.1f)"
    Disagreement(s"relative mean squared error: $numbers", p)

object Agreement:
  /** Pixels along the side of a block, beside the whole image. */
  val BlockSizes: Vector[Int] = Vector(8, 32)

  /** References are stored as half floats, whose 11 bits round by at most this part of the
    * value.
    */
  val HalfRounding: Double = 1.0 / (1 << 11)

  /** The same as in [[candela.measure.Metrics]]. */
  val RelativeEpsilon: Double = 0.01

  /** How many disagreements could be found in an image of this size. */
  def questions(width: Int, height: Int): Int =
    def parts(size: Int, block: Int) = (size + block - 1) / block
    3 * (BlockSizes.map(b => parts(width, b) * parts(height, b)).sum + 1) + 1

  /** Chance that Student's t is beyond ±t, by Wallace's normal deviate. It overstates small chances
    * where degrees of freedom are few, so that a disagreement is more likely missed than invented:
    * one of 1e-4 by 54 % at 3 degrees, by 5 % at 10.
    *
    * Source: Wallace, "Bounds on normal approximations to Student's and the chi-square
    * distributions", Annals of Mathematical Statistics 30, 1959.
    */
  def twoSided(t: Double, freedom: Double): Double =
    if t == 0 then 1.0
    else if t.isInfinite then 0.0
    else
      val scale = (8 * freedom + 1) / (8 * freedom + 3)
      val z = scale * Math.sqrt(freedom * Math.log1p(t * t / freedom))
      IncompleteGamma.upper(0.5, z * z / 2) // of the normal distribution, both tails

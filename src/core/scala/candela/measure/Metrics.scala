package candela.measure

import candela.base.loop
import candela.diagnostics.Code
import candela.color.Srgb
import candela.image.{Image, ImageError}

/** The largest difference between two images. */
final case class LargestDifference(value: Double, x: Int, y: Int, channel: String)

/** Metrics of one channel, as defined in [[Metrics]]. */
final case class ChannelMetrics(
    name: String,
    mse: Double,
    mae: Double,
    relativeMse: Double,
    mean: Double,
    referenceMean: Double
):
  def rmse: Double = Math.sqrt(mse)
  def meanRatio: Double = if mean == referenceMean then 1 else mean / referenceMean

/** Error metrics of an image against its reference; docs/METRICS.md has the definitions. Values for
  * the whole image are averages over the channels.
  *
  * @param psnr decibels, of display values: sRGB-encoded, clamped to [0, 1], peak 1; infinite for
  *   equal images
  * @param largest the largest |a − b|, in linear values
  * @param skipped number of pixels excluded from all metrics, because one of the two is NaN or
  *   infinite
  */
final case class Metrics(
    perChannel: Vector[ChannelMetrics],
    psnr: Double,
    largest: LargestDifference,
    skipped: Int
):
  def channels: Vector[String] = perChannel.map(_.name)

  /** Mean squared error, linear values. */
  def mse: Double = mean(_.mse)

  def rmse: Double = Math.sqrt(mse)

  /** Mean absolute error. */
  def mae: Double = mean(_.mae)

  /** Mean of ((a − b) / (b + 0.01))², b the reference: equal to pbrt-v4's `imgtool diff --metric
    * MRSE`.
    */
  def relativeMse: Double = mean(_.relativeMse)

  /** Mean over the reference's mean, per channel; 1 if both are 0. */
  def meanRatio: Vector[Double] = perChannel.map(_.meanRatio)

  /** Largest deviation of a channel's mean ratio from 1. */
  def bias: Double = meanRatio.map(r => Math.abs(r - 1)).max

  private def mean(figure: ChannelMetrics => Double): Double =
    perChannel.map(figure).sum / perChannel.size

object Metrics:

  /** Bounds the relative error of dark pixels; pbrt's value. */
  val RelativeEpsilon: Double = 0.01

  /** Compares R, G and B if both images have them, else requires equal sets of channels. Decodes
    * encoded images first.
    *
    * @throws ImageError if sizes or channels differ
    */
  def compare(image: Image, reference: Image): Metrics =
    val pair = ImagePair(image, reference)
    val sums = Sums(pair)
    loop(pair.height)(y => loop(pair.width)(x => sums.add(x, y)))
    sums.result

  private final class Sums(pair: ImagePair):
    private val count = pair.channels.size
    private val means, referenceMeans = new Array[Double](count)
    private val squares, absolutes, relatives = new Array[Double](count)
    private var encodedSquares = 0.0
    private var largest = LargestDifference(0, 0, 0, pair.channels.head)
    private var pixels, skipped = 0

    def add(x: Int, y: Int): Unit =
      if pair.isFinite(x, y) then
        pixels += 1
        loop(count)(c => addChannel(x, y, c))
      else skipped += 1

    private def addChannel(x: Int, y: Int, c: Int): Unit =
      val a = pair.image(x, y, c)
      val b = pair.reference(x, y, c)
      val difference = a.toDouble - b
      means(c) += a
      referenceMeans(c) += b
      squares(c) += difference * difference
      absolutes(c) += Math.abs(difference)
      relatives(c) += Metrics.relativeSquare(a, b)
      val encodedDifference = encoded(a) - encoded(b)
      encodedSquares += encodedDifference * encodedDifference
      if Math.abs(difference) > largest.value then
        largest = LargestDifference(Math.abs(difference), x, y, pair.channels(c))

    private def encoded(value: Float): Double =
      Srgb.encode(Math.min(1f, Math.max(0f, value))).toDouble

    def result: Metrics =
      if pixels == 0 then throw ImageError(Code.NothingFinite, "no pixel is finite in both images")
      val n = pixels.toDouble
      val perChannel = Vector.tabulate(count): c =>
        ChannelMetrics(
          pair.channels(c),
          squares(c) / n,
          absolutes(c) / n,
          relatives(c) / n,
          means(c) / n,
          referenceMeans(c) / n
        )
      val psnr =
        if encodedSquares == 0 then Double.PositiveInfinity
        else -10 * Math.log10(encodedSquares / (n * count))
      Metrics(perChannel, psnr, largest, skipped)

  /** Skips a reference of exactly −0.01, for which the relative error is undefined, as pbrt does.
    */
  private[measure] def relativeSquare(a: Float, b: Float): Double =
    val relative = (a.toDouble - b) / (b + RelativeEpsilon)
    if java.lang.Double.isFinite(relative) then relative * relative else 0

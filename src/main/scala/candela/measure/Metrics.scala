package candela.measure

import candela.base.loop
import candela.color.Srgb
import candela.image.{Image, ImageError}

/** Where two pictures differ most. */
final case class LargestDifference(value: Double, x: Int, y: Int, channel: String)

/** How one channel differs; definitions as in [[Metrics]]. */
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

/** How a picture differs from its reference: docs/METRICS.md has the definitions. Figures of the
  * whole are means over the channels.
  *
  * @param psnr    decibels, of the values as a screen shows them: sRGB-encoded, clamped to [0, 1],
  *                peak 1; infinite for equal pictures
  * @param largest of |a − b|, linear light
  * @param skipped pixels left out of all figures, because one of the two is NaN or infinite there
  */
final case class Metrics(
    perChannel: Vector[ChannelMetrics],
    psnr: Double,
    largest: LargestDifference,
    skipped: Int
):
  def channels: Vector[String] = perChannel.map(_.name)

  /** Mean squared error, linear light. */
  def mse: Double = mean(_.mse)

  def rmse: Double = Math.sqrt(mse)

  /** Mean absolute error. */
  def mae: Double = mean(_.mae)

  /** Mean of ((a − b) / (b + 0.01))², b the reference: what pbrt-v4's `imgtool diff --metric MRSE`
    * prints.
    */
  def relativeMse: Double = mean(_.relativeMse)

  /** Of each channel, the mean over that of the reference; 1 if both are 0. */
  def meanRatio: Vector[Double] = perChannel.map(_.meanRatio)

  /** How far the mean ratio of any channel is from 1. */
  def bias: Double = meanRatio.map(r => Math.abs(r - 1)).max

  private def mean(figure: ChannelMetrics => Double): Double =
    perChannel.map(figure).sum / perChannel.size

object Metrics:

  /** Keeps the relative error of dark pixels finite; the value is pbrt's. */
  val RelativeEpsilon: Double = 0.01

  /** Compares R, G and B if both have them, else requires equal sets of channels. Encoded pictures
    * are decoded first.
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
      val shown = encoded(a) - encoded(b)
      encodedSquares += shown * shown
      if Math.abs(difference) > largest.value then
        largest = LargestDifference(Math.abs(difference), x, y, pair.channels(c))

    private def encoded(value: Float): Double =
      Srgb.encode(Math.min(1f, Math.max(0f, value))).toDouble

    def result: Metrics =
      if pixels == 0 then throw ImageError("no pixel is finite in both pictures")
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

  /** A reference of exactly −0.01 says nothing about relative error; pbrt skips it too. */
  private[measure] def relativeSquare(a: Float, b: Float): Double =
    val relative = (a.toDouble - b) / (b + RelativeEpsilon)
    if java.lang.Double.isFinite(relative) then relative * relative else 0

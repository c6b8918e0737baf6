package candela.measure

import candela.base.loop
import candela.color.Srgb
import candela.image.{Image, ImageError}

/** Where two pictures differ most. */
final case class LargestDifference(value: Double, x: Int, y: Int, channel: String)

/** How a picture differs from its reference; means are over pixels and channels.
  *
  * @param mse         mean squared error, linear light
  * @param relativeMse mean of ((a − b) / (b + 0.01))², b the reference: what pbrt-v4's
  *                    `imgtool diff --metric MRSE` prints
  * @param psnr        decibels, of the values as a screen shows them: sRGB-encoded, clamped to [0,
  *                    1], peak 1; infinite for equal pictures
  * @param meanRatio   of each channel, the mean over that of the reference; 1 if both are 0
  * @param largest     of |a − b|, linear light
  * @param skipped     pixels left out of all figures, because one of the two is NaN or infinite
  *                    there
  */
final case class Metrics(
    channels: Vector[String],
    mse: Double,
    relativeMse: Double,
    psnr: Double,
    meanRatio: Vector[Double],
    largest: LargestDifference,
    skipped: Int
)

object Metrics:

  /** Keeps the relative error of dark pixels finite; the value is pbrt's. */
  val RelativeEpsilon: Double = 0.01

  /** Compares R, G and B if both have them, else requires equal sets of channels. Encoded pictures
    * are decoded first.
    *
    * @throws ImageError if sizes or channels differ
    */
  def compare(image: Image, reference: Image): Metrics =
    if image.width != reference.width || image.height != reference.height then
      def size(i: Image) = s"${i.width}×${i.height}"
      throw ImageError(s"pictures of different size: ${size(image)} and ${size(reference)} pixels")
    val names = commonChannels(image, reference)
    val sums = Sums(image.linear, reference.linear, names)
    loop(image.height)(y => loop(image.width)(x => sums.add(x, y)))
    sums.result

  private def commonChannels(image: Image, reference: Image): Vector[String] =
    val isColor = image.indicesOf(Image.RgbNames).isDefined &&
      reference.indicesOf(Image.RgbNames).isDefined
    if isColor then Image.RgbNames
    else if image.channelNames.toSet == reference.channelNames.toSet then reference.channelNames
    else
      def list(i: Image) = i.channelNames.mkString(", ")
      throw ImageError(s"pictures of different channels: ${list(image)} and ${list(reference)}")

  private final class Sums(image: Image, reference: Image, names: Vector[String]):
    private val inImage = names.map(image.channelNames.indexOf).toArray
    private val inReference = names.map(reference.channelNames.indexOf).toArray
    private val count = names.size
    private val means = new Array[Double](count)
    private val referenceMeans = new Array[Double](count)
    private var squares, relativeSquares, encodedSquares = 0.0
    private var largest = LargestDifference(0, 0, 0, names.head)
    private var pixels, skipped = 0

    def add(x: Int, y: Int): Unit =
      var finite = true
      loop(count): c =>
        val a = image(x, y, inImage(c))
        val b = reference(x, y, inReference(c))
        if !java.lang.Float.isFinite(a) || !java.lang.Float.isFinite(b) then finite = false
      if finite then
        pixels += 1
        loop(count)(c => addChannel(x, y, c))
      else skipped += 1

    private def addChannel(x: Int, y: Int, c: Int): Unit =
      val a = image(x, y, inImage(c))
      val b = reference(x, y, inReference(c))
      val difference = a.toDouble - b
      means(c) += a
      referenceMeans(c) += b
      squares += difference * difference
      val relative = difference / (b + RelativeEpsilon)
      // A reference of exactly −0.01 says nothing about relative error; pbrt skips it too.
      if java.lang.Double.isFinite(relative) then relativeSquares += relative * relative
      val shown = encoded(a) - encoded(b)
      encodedSquares += shown * shown
      if Math.abs(difference) > largest.value then
        largest = LargestDifference(Math.abs(difference), x, y, names(c))

    private def encoded(value: Float): Double =
      Srgb.encode(Math.min(1f, Math.max(0f, value))).toDouble

    def result: Metrics =
      if pixels == 0 then throw ImageError("no pixel is finite in both pictures")
      val values = pixels.toDouble * count
      Metrics(
        names,
        squares / values,
        relativeSquares / values,
        if encodedSquares == 0 then Double.PositiveInfinity
        else -10 * Math.log10(encodedSquares / values),
        Vector.tabulate(count): c =>
          if means(c) == referenceMeans(c) then 1 else means(c) / referenceMeans(c),
        largest,
        skipped
      )

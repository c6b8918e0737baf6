package candela.gallery

import candela.base.loop
import candela.image.Image

/** How a picture looks on a screen: shares of pixels, and sRGB-encoded values.
  *
  * @param mean   of the brightness
  * @param spread its standard deviation
  * @param black  share of pixels
  * @param white  share of pixels
  * @param noise  standard deviation of what differs between neighbours, where there is much
  */
final case class Looks(mean: Double, spread: Double, black: Double, white: Double, noise: Double):

  /** What keeps it from showing anything. */
  def faults: Vector[String] = Vector(
    Option.when(mean < Looks.Darkest || black > Looks.MaxClipped)("black"),
    Option.when(mean > Looks.Brightest || white > Looks.MaxClipped)("white"),
    Option.when(spread < Looks.MinSpread)("of one colour"),
    Option.when(noise > Looks.MaxNoise)("noisy")
  ).flatten

object Looks:
  private val Darkest = 0.15
  private val Brightest = 0.85
  private val MaxClipped = 0.3
  private val MinSpread = 0.04

  /** Five times what rounding to 8 bits makes is hardly seen. */
  private val MaxNoise = 0.006

  /** @param picture of 8 bits */
  def of(picture: Image): Looks =
    val pixels = picture.width * picture.height
    val brightness = new Array[Double](pixels)
    var black, white = 0
    loop(pixels): i =>
      val (r, g, b) = (picture.data(3 * i), picture.data(3 * i + 1), picture.data(3 * i + 2))
      brightness(i) = 0.2126 * r + 0.7152 * g + 0.0722 * b
      if Math.max(r, Math.max(g, b)) < 0.02f then black += 1
      if Math.min(r, Math.min(g, b)) > 0.99f then white += 1
    val mean = brightness.sum / pixels
    val variance = brightness.map(v => (v - mean) * (v - mean)).sum / pixels
    def share(count: Int) = count.toDouble / pixels
    val noise = noiseOf(brightness, picture.width, picture.height)
    Looks(mean, Math.sqrt(variance), share(black), share(white), noise)

  /** Edges cover less than half of most blocks, which medians ignore. A fifth of the picture may
    * have fine detail.
    *
    * Source: Immerkær, "Fast Noise Variance Estimation", Computer Vision and Image Understanding
    * 64 (1996), with medians in place of means.
    */
  private def noiseOf(brightness: Array[Double], width: Int, height: Int): Double =
    def row(at: Int, side: Double) =
      side * (brightness(at - 1) - 2 * brightness(at) + brightness(at + 1))
    val differences = new Array[Double](Block * Block)
    val medians =
      for top <- 1 to height - 1 - Block by Block; left <- 1 to width - 1 - Block by Block yield
        loop(Block * Block): i =>
          val at = (top + i / Block) * width + left + i % Block
          differences(i) = Math.abs(row(at - width, 1) + row(at, -2) + row(at + width, 1))
        java.util.Arrays.sort(differences)
        differences(differences.length / 2)
    val high = medians.sorted.apply(medians.size * 4 / 5)
    // The filter's norm is 6; the median of a normal deviation is 0.6745 of its standard one
    high / (6 * 0.6745)

  /** Width and height, in pixels. */
  private val Block = 24

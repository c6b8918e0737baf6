package candela.film

import candela.base.loop

/** Leaves out light that too few samples have found to be trusted.
  *
  * A level of brightness is trusted where the 3 × 3 pixels around have several samples of it, or of
  * the levels next to it; or where a sample more or less makes little difference. Samples of lower
  * levels say what is little. With more samples per pixel both hold for ever brighter levels, so
  * that the image converges to the right one.
  *
  * Source: Zirr, Hanika, Dachsbacher, "Re-Weighting Firefly Samples for Improved Finite-Sample
  * Monte Carlo Estimates", Computer Graphics Forum 37(6), 2018. There, brightness at which trust is
  * needed is a parameter; here it follows from the image.
  *
  * @param volume what a sample adds to the weights of all pixels
  */
private[film] final class FireflyWeights(
    levels: BrightnessLevels,
    bounds: PixelBounds,
    volume: Double
):
  import FireflyWeights.*
  private val pixels = bounds.width * bounds.height
  private val box = Box3(bounds.width, bounds.height)

  /** Subtracts what is not trusted.
    *
    * @param sums of each pixel, row by row: weighted red, green, blue, sum of weights
    */
  def apply(sums: Array[Double]): Unit =
    val floor = MinBrightness * typical(sums)
    val trusted = new Array[Double](pixels) // brightness of the trusted light so far
    val surroundings, neighbours = new Array[Double](pixels)
    var previous = Level(-1)
    var level = Level(0)
    loop(BrightnessLevels.Count): i =>
      val after = Level(i + 1)
      if level.isThere then
        loop(pixels)(p => neighbours(p) = previous.counts(p) + level.counts(p) + after.counts(p))
        box.sum(neighbours)
        System.arraycopy(trusted, 0, surroundings, 0, pixels)
        box.sum(surroundings)
        loop(pixels): p =>
          val weight = sums(4 * p + 3)
          if level.counts(p) != 0 && weight != 0 then
            val little = Little * (surroundings(p) / box.size(p) + floor)
            val effect = BrightnessLevels.brightness(i) * volume / Math.abs(weight)
            val support = Math.max((neighbours(p) - Alone) / TrustedNeighbours, little / effect)
            val trust = Math.max(0.0, Math.min(1.0, support))
            if trust < 1 then
              loop(3)(c => sums(4 * p + c) -= (1 - trust) * level.light(3 * p + c))
            trusted(p) += trust * brightest(level.light, 3 * p) / weight
      previous = level
      level = after

  /** Geometric mean of the brightness of all pixels that have any; fireflies matter little. */
  private def typical(sums: Array[Double]): Double =
    var sum = 0.0
    var count = 0
    loop(pixels): p =>
      val bright = brightest(sums, 4 * p) / sums(4 * p + 3)
      if bright > 0 && bright < Double.PositiveInfinity then
        sum += Math.log(bright)
        count += 1
    if count == 0 then 0 else Math.exp(sum / count)

  /** Light and number of samples of a level, in all pixels. */
  private final class Level(i: Int):
    val light: Array[Double] = new Array[Double](3 * pixels)
    val isThere: Boolean =
      i >= 0 && i < BrightnessLevels.Count && levels.read(i, bounds, light)
    val counts: Array[Double] = new Array[Double](pixels)
    if isThere then
      val perSample = BrightnessLevels.brightness(i) * volume
      loop(pixels)(p => counts(p) = brightest(light, 3 * p) / perSample)

private[film] object FireflyWeights:
  /** Samples around that one sample counts for at most: filters with negative lobes count it for
    * more than one.
    */
  private val Alone = 1.5

  /** A level is trusted if it has this many further samples around. */
  private val TrustedNeighbours = 4.0

  /** Share of its surroundings by which any sample may change a pixel. */
  private val Little = 0.1

  /** Darker surroundings count as if they were this bright, relative to the image. */
  private val MinBrightness = 0.01

  /** The largest of three values. */
  private def brightest(data: Array[Double], at: Int): Double =
    Math.max(data(at), Math.max(data(at + 1), data(at + 2)))

/** Sums over the 3 × 3 pixels around each one, as far as they are in the image. */
private final class Box3(width: Int, height: Int):
  private val rows = new Array[Double](width * height)

  /** Replaces values by their sums. */
  def sum(values: Array[Double]): Unit =
    loop(height): y =>
      loop(width): x =>
        val pixel = y * width + x
        val left = if x > 0 then values(pixel - 1) else 0.0
        val right = if x + 1 < width then values(pixel + 1) else 0.0
        rows(pixel) = left + values(pixel) + right
    loop(height): y =>
      loop(width): x =>
        val pixel = y * width + x
        val above = if y > 0 then rows(pixel - width) else 0.0
        val below = if y + 1 < height then rows(pixel + width) else 0.0
        values(pixel) = above + rows(pixel) + below

  /** Number of pixels around one. */
  def size(pixel: Int): Int = reach(pixel % width, width) * reach(pixel / width, height)

  private def reach(at: Int, size: Int): Int =
    1 + (if at > 0 then 1 else 0) + (if at + 1 < size then 1 else 0)

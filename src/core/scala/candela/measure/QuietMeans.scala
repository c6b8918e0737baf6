package candela.measure

import candela.base.{GivenUp, loop}
import candela.image.Image

/** Pixel means for relative errors. The noisier a pixel is, the more it takes the mean of those
  * around that differ from it by noise, and of itself: a firefly must not hide its own error, nor
  * its neighbours, which lack it, make that seem larger than it is.
  *
  * A pixel at the edge of an emitter is noisy, too, and far above the dark around. But the whole
  * emitter is in a pixel beside it: one that is quiet, and brighter by more than noise. Its own
  * mean holds. If an emitter covers an unknown part of a pixel, uniformly distributed, then as many
  * pixels have one sample of it as have none; these miss all of their light, and seem to have no
  * error. So the squared errors of the noisiest count twice.
  *
  * @param variance of each value
  * @param isStopped whether to give up
  */
final class QuietMeans(
    image: Image,
    variance: Array[Float],
    isStopped: () => Boolean = GivenUp.Never
):
  private val channels = image.channels

  // 1 / (mean + 0.01)²
  private val weights = new Array[Float](image.data.length)
  loop(image.height): y =>
    GivenUp.check(isStopped)
    loop(image.width): x =>
      loop(channels): c =>
        val at = index(x, y, c)
        val own = Math.max(image.data(at), 0f).toDouble
        val share = doubt(at)
        weights(at) = weightBy(if share < QuietMeans.Quiet then own else noisy(x, y, c, own, share))

  /** The weight of a squared error, by which it is relative. */
  def weight(i: Int): Float = weights(i)

  /** The same if the pixel's own mean is true, however noisy it is. */
  def ownWeight(i: Int): Float = weightBy(Math.max(image.data(i), 0f))

  private def weightBy(mean: Double): Float =
    (1 / square(mean + Metrics.RelativeEpsilon)).toFloat

  /** The mean of a pixel that is noisy.
    *
    * @param share of its surroundings in it
    */
  private def noisy(x: Int, y: Int, c: Int, own: Double, share: Double): Double =
    val mean = own + (around(x, y, c) - own) * share
    val ofEdge = own * (1 - share * QuietMeans.Missed)
    if ofEdge > mean && isEdge(x, y, c) then ofEdge else mean

  /** The share of its surroundings in the mean of a value, unless it is at an edge. */
  private def doubt(i: Int): Double =
    val own = Math.max(image.data(i), 0f).toDouble
    Math.min(1, QuietMeans.Doubt * variance(i) / square(own + Metrics.RelativeEpsilon))

  /** Whether a pixel beside it is quiet, and brighter by more than noise. */
  private def isEdge(x: Int, y: Int, c: Int): Boolean =
    val at = index(x, y, c)
    var found = false
    near(x, y, c, radius = 1): i =>
      found ||= image.data(i) > image.data(at) && !isAlike(i, at) && doubt(i) < QuietMeans.Quiet
    found

  /** Mean of the pixels around that differ by noise, and of itself. */
  private def around(x: Int, y: Int, c: Int): Double =
    val at = index(x, y, c)
    val own = image.data(at).toDouble
    var sum = 0.0
    var all = 0
    near(x, y, c, QuietMeans.Radius): i =>
      if i != at && isAlike(i, at) then
        sum += Math.max(image.data(i), 0f)
        all += 1
    if all == 0 then Math.max(own, 0)
    else (sum + Math.max(0, Math.min(own, QuietMeans.Brightest * sum / all))) / (all + 1)

  /** Do two values differ by noise only? */
  private def isAlike(i: Int, k: Int): Boolean =
    square(image.data(i) - image.data(k).toDouble) <=
      QuietMeans.Spread * (variance(k).toDouble + variance(i))

  private def index(x: Int, y: Int, c: Int): Int = (y * image.width + x) * channels + c

  /** Calls `use` with the index of each pixel so near, and of itself. */
  private inline def near(x: Int, y: Int, c: Int, radius: Int)(inline use: Int => Unit): Unit =
    loop(Math.max(0, y - radius), Math.min(image.height, y + radius + 1)): ny =>
      loop(Math.max(0, x - radius), Math.min(image.width, x + radius + 1)): nx =>
        use(index(nx, ny, c))

  private def square(a: Double): Double = a * a

private object QuietMeans:
  val Radius = 2

  /** From a relative variance of one over this on, a pixel's mean says no more than each of the
    * others.
    */
  val Doubt = 4.0

  /** A pixel that takes less of its surroundings is quiet: its own mean is true. */
  val Quiet = 0.05

  /** By this part the mean of the noisiest pixels at an edge is lowered: their weight is then twice
    * as large, for those that missed the emitter.
    */
  val Missed: Double = 1 - Math.sqrt(0.5)

  /** A pixel counts no more than this many times the mean of the others. */
  val Brightest = 2.0

  /** Squared difference over variance: three standard deviations. */
  val Spread = 9

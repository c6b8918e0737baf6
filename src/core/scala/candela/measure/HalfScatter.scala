package candela.measure

import candela.base.loop
import candela.concurrency.GivenUp
import candela.image.Image

/** Estimates the error of an image that gets ever more samples: from the scatter between halves of
  * its samples after 2, 4, 8, … per pixel.
  *
  * Relative errors divide by [[LocalMeans]]: a rare bright path makes its own pixel bright, too,
  * and would hide its error. Light that no path has found is unknown.
  */
final class HalfScatter:
  import HalfScatter.State
  private var former = Option.empty[State]
  private var scatters = Option.empty[Array[Float]]
  private var latest = Option.empty[ErrorEstimate]

  /** The latest; None before the first. */
  def estimate: Option[ErrorEstimate] = latest

  /** The squared error of each value of the image after so many samples per pixel. */
  def squares(samples: Double): Option[Array[Float]] =
    for e <- latest; values <- scatters
    yield
      val scale = e.samples / samples
      values.map(v => (v * scale).toFloat)

  /** Whether the state after so many samples per pixel is used: after 2ᵏ, of a continued rendering
    * the first, and the last if there is no estimate yet.
    */
  def uses(samples: Int, isLast: Boolean): Boolean =
    former.isEmpty || Integer.bitCount(samples) == 1 || isLast && latest.isEmpty

  /** Adds the state of the image after so many samples per pixel, more than before, if it is used.
    *
    * @param weights of each pixel's samples
    * @param isStopped whether to give up; then nothing changes
    * @return the estimate, if it is new
    */
  def add(
      samples: Int,
      image: Image,
      weights: Array[Float],
      isLast: Boolean,
      isStopped: () => Boolean = GivenUp.Never
  ): Option[ErrorEstimate] =
    val state = State(samples, image, weights)
    former match
      case None =>
        former = Some(state)
        None
      case Some(half) if uses(samples, isLast) =>
        val values = HalfScatter.scatter(half, state, isStopped)
        val estimate = HalfScatter.estimate(state, values, isStopped)
        former = Some(state)
        scatters = Some(values)
        latest = Some(estimate)
        latest
      case _ => None

object HalfScatter:
  private final case class State(samples: Int, image: Image, weights: Array[Float])

  /** (A − B)² times both shares of the weight, which is (A − B)² / 4 for equal halves. */
  private def scatter(half: State, now: State, isStopped: () => Boolean): Array[Float] =
    val values = new Array[Float](now.image.data.length)
    val channels = now.image.channels
    loop(now.weights.length): pixel =>
      GivenUp.check(isStopped, pixel)
      val firstWeight = half.weights(pixel).toDouble
      val total = now.weights(pixel).toDouble
      val secondWeight = total - firstWeight
      if firstWeight * secondWeight > 0 then
        loop(channels): c =>
          val i = pixel * channels + c
          // A − B is this over the share of B, as the image is the weighted mean of both
          val change = half.image.data(i).toDouble - now.image.data(i)
          values(i) = (change * change * firstWeight / secondWeight).toFloat
    values

  private def estimate(
      now: State,
      values: Array[Float],
      isStopped: () => Boolean
  ): ErrorEstimate =
    val image = now.image
    val means = LocalMeans(image, values)
    var absolute, relative, lowest, squares = 0.0
    loop(image.height): y =>
      GivenUp.check(isStopped)
      loop(image.width): x =>
        var pixel = 0.0
        loop(image.channels): c =>
          val i = (y * image.width + x) * image.channels + c
          val mean = means(x, y, c)
          val weight = LocalMeans.weight(mean)
          absolute += values(i)
          pixel += values(i) * weight
          lowest += values(i) * LocalMeans.weight(Math.max(mean, image.data(i)))
        relative += pixel
        squares += pixel * pixel
    val pixels = if squares > 0 then relative * relative / squares else values.length.toDouble
    val count = values.length
    ErrorEstimate(now.samples, absolute / count, relative / count, lowest / count, pixels)

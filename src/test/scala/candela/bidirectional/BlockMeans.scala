package candela.bidirectional

import candela.image.Image

import org.scalatest.Assertion
import org.scalatest.Assertions.*

/** Whether two renderings with different seeds have the same mean in each block of pixels. */
private object BlockMeans:
  private val Side = 16

  /** Pixels have noise of their own, so in each block their differences tell what the error of
    * their mean is. Normal numbers are beyond 5 once in two million times, but these have tails.
    *
    * @param channels that are compared; they count as one, as their noise is not independent
    */
  def assertEqual(a: Image, b: Image, channels: Seq[Int] = 0 to 2, clue: String = ""): Assertion =
    assert(a.channelNames == b.channelNames)
    val scores =
      for
        y <- Vector.range(0, a.height, Side)
        x <- Vector.range(0, a.width, Side)
      yield
        val all =
          for j <- Vector.range(y, y + Side); i <- x until x + Side; c <- channels
          yield a(i, j, c).toDouble - b(i, j, c)
        mean(all) / Math.sqrt(variance(all) / (all.size / channels.size))
    assert(scores.forall(z => z.isNaN || z.abs < 5.0), s"$clue $scores")

  private def mean(of: Vector[Double]): Double = of.sum / of.size

  private def variance(of: Vector[Double]): Double =
    val middle = mean(of)
    of.map(x => (x - middle) * (x - middle)).sum / (of.size - 1)

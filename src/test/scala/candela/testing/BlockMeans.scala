package candela.testing

import candela.image.Image

import org.scalatest.Assertion
import org.scalatest.Assertions.*

/** Whether two renderings with different seeds have the same mean in each block of pixels. */
object BlockMeans:
  private val Side = 16

  /** Pixels have noise of their own, so in each block their differences tell what the error of
    * their mean is. Normal numbers are beyond 5 once in two million times, but these have tails.
    *
    * @param channels  that are compared; they count as one, as their noise is not independent
    * @param allowance relative difference that is no fault
    */
  def assertEqual(
      a: Image,
      b: Image,
      channels: Seq[Int] = 0 to 2,
      clue: String = "",
      allowance: Double = 0.0
  ): Assertion =
    assert(a.channelNames == b.channelNames)
    val scores =
      for
        y <- Vector.range(0, a.height, Side)
        x <- Vector.range(0, a.width, Side)
      yield
        val (ours, theirs) = (values(a, x, y, channels), values(b, x, y, channels))
        val apart = ours.lazyZip(theirs).map(_ - _)
        val excess = Math.max(0.0, Math.abs(mean(apart)) - allowance * Math.abs(mean(theirs)))
        excess / Math.sqrt(variance(apart) / (apart.size / channels.size))
    assert(scores.forall(z => z.isNaN || z < 5.0), s"$clue $scores")

  private def values(of: Image, x: Int, y: Int, channels: Seq[Int]): Vector[Double] =
    for
      j <- Vector.range(y, Math.min(y + Side, of.height))
      i <- x until Math.min(x + Side, of.width)
      c <- channels
    yield of(i, j, c).toDouble

  private def mean(of: Vector[Double]): Double = of.sum / of.size

  private def variance(of: Vector[Double]): Double =
    val middle = mean(of)
    of.map(x => (x - middle) * (x - middle)).sum / (of.size - 1)

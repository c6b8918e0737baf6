package candela.measure

import candela.base.loop
import candela.image.Image

/** Pixel means for relative errors: each the best combination of a pixel's own value, which has a
  * variance, and the mean of its neighbours, which may differ from it.
  *
  * The mean of n neighbours m is off by their noise, v / n, and by how much pixels differ here: the
  * sample variance of the neighbours less their noise, s² − v. Two estimates are combined by the
  * inverse of their squared errors (Efron, Morris, "Stein's estimation rule and its competitors",
  * JASA 68, 1973; for images Lee, "Digital image enhancement and noise filtering by use of local
  * statistics", IEEE PAMI 2(2), 1980). So a firefly has the mean of what is around, and the edge of
  * an emitter, where pixels differ much, its own.
  *
  * @param variance of each value
  */
final class LocalMeans(image: Image, variance: Array[Float]):
  private val channels = image.channels

  /** The expected relative MSE of the image. */
  def relativeMse: Double =
    var sum = 0.0
    loop(image.height): y =>
      loop(image.width): x =>
        loop(channels)(c => sum += variance(index(x, y, c)) * LocalMeans.weight(this(x, y, c)))
    sum / variance.length

  def apply(x: Int, y: Int, c: Int): Double =
    val center = index(x, y, c)
    val value = positive(center)
    val noise = variance(center).toDouble
    var count = 0
    var sum, squares, noises = 0.0
    if noise > 0 then
      loop(Math.max(0, y - 1), Math.min(image.height, y + 2)): ny =>
        loop(Math.max(0, x - 1), Math.min(image.width, x + 2)): nx =>
          val i = index(nx, ny, c)
          if i != center then
            val neighbour = positive(i)
            count += 1
            sum += neighbour
            squares += neighbour * neighbour
            noises += variance(i)
    if count < 2 then value
    else
      val mean = sum / count
      val differences = (squares - sum * mean) / (count - 1) - noises / count
      val error = Math.max(0, differences) + noises / count / count
      value + (mean - value) * noise / (noise + error)

  private def positive(i: Int): Double = Math.max(0f, image.data(i)).toDouble

  private def index(x: Int, y: Int, c: Int): Int = (y * image.width + x) * channels + c

object LocalMeans:
  /** By which a squared error is relative: 1 / (mean + 0.01)². */
  def weight(mean: Double): Double =
    val scale = mean + Metrics.RelativeEpsilon
    1 / (scale * scale)

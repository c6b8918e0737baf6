package candela.measure

import candela.base.loop
import candela.image.{Image, ImageError}

/** What a difference of pictures can be measured by; docs/METRICS.md has definitions and sources.
  *
  * @param word  as it is written on the command line and in files
  * @param title as people read it
  */
enum Metric(val word: String, val title: String):
  case Mse extends Metric("mse", "MSE")
  case Rmse extends Metric("rmse", "RMSE")
  case Mae extends Metric("mae", "MAE")
  case RelativeMse extends Metric("relmse", "relative MSE")
  case Psnr extends Metric("psnr", "PSNR")
  case Flip extends Metric("flip", "FLIP")

  /** PSNR is of whole pictures only, and larger is better. */
  def hasMap: Boolean = this != Psnr

object Metric:
  def named(word: String): Option[Metric] = Metric.values.find(_.word == word.toLowerCase)

/** The error of each pixel, as a picture of the one channel `Y`. */
object ErrorMap:

  /** Means over the channels; pixels that can't be compared are 0.
    *
    * @throws ImageError if the metric has no map, or needs colours
    */
  def apply(metric: Metric, pair: ImagePair): Image = metric match
    case Metric.Mse => each(pair)((a, b) => (a.toDouble - b) * (a.toDouble - b))
    case Metric.Mae => each(pair)((a, b) => Math.abs(a.toDouble - b))
    case Metric.RelativeMse => each(pair)(Metrics.relativeSquare)
    case Metric.Rmse =>
      val squares = apply(Metric.Mse, pair)
      gray(pair, squares.data.map(v => Math.sqrt(v.toDouble).toFloat))
    case Metric.Flip =>
      if !pair.isColor then throw ImageError("FLIP is about colours: it needs R, G and B")
      Flip.map(pair)
    case Metric.Psnr => throw ImageError("PSNR is of whole pictures: it has no map")

  def mean(map: Image): Double =
    var sum = 0.0
    loop(map.data.length)(i => sum += map.data(i))
    sum / map.data.length

  private def each(pair: ImagePair)(error: (Float, Float) => Double): Image =
    val count = pair.channels.size
    val data = new Array[Float](pair.width * pair.height)
    loop(pair.height): y =>
      loop(pair.width): x =>
        if pair.isFinite(x, y) then
          var sum = 0.0
          loop(count)(c => sum += error(pair.image(x, y, c), pair.reference(x, y, c)))
          data(y * pair.width + x) = (sum / count).toFloat
    gray(pair, data)

  private def gray(pair: ImagePair, data: Array[Float]): Image =
    Image(pair.width, pair.height, Vector("Y"), data)

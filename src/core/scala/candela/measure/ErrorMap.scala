package candela.measure

import candela.base.loop
import candela.diagnostics.Code
import candela.color.{Encoding, Magma}
import candela.image.{Image, ImageError}

/** Per-pixel error as an image of the single channel `Y`. */
object ErrorMap:

  /** Average over the channels; pixels with NaN or infinite values are 0.
    *
    * @throws ImageError if the metric has no map, or needs RGB
    */
  def apply(metric: Metric, pair: ImagePair): Image = metric match
    case Metric.Mse => perPixel(pair)((a, b) => (a.toDouble - b) * (a.toDouble - b))
    case Metric.Mae => perPixel(pair)((a, b) => Math.abs(a.toDouble - b))
    case Metric.RelativeMse => perPixel(pair)(Metrics.relativeSquare)
    case Metric.Rmse =>
      val squares = apply(Metric.Mse, pair)
      gray(pair, squares.data.map(v => Math.sqrt(v.toDouble).toFloat))
    case Metric.Flip =>
      if !pair.isColor then
        throw ImageError(Code.DifferentImages, "FLIP needs the channels R, G, B")
      Flip.map(pair)
    case Metric.Psnr => throw ImageError(Code.DifferentImages, "PSNR has no per-pixel map")

  private def perPixel(pair: ImagePair)(error: (Float, Float) => Double): Image =
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

/** Images in the false colours of [[Magma]]. */
object HeatMap:

  /** A single-channel image in false colours; `brightest` and above map to the last colour. */
  def of(map: Image, brightest: Double): Image =
    val data = new Array[Float](3 * map.data.length)
    loop(map.data.length): i =>
      val value = if brightest > 0 then map.data(i) / brightest else 0.0
      loop(3)(c => data(3 * i + c) = Magma(value, c))
    Image(map.width, map.height, Image.RgbNames, data, Encoding.Srgb)

  /** Default top of the scale: FLIP's maximum; for other metrics the 99th percentile. */
  def usualBrightest(metric: Metric, map: Image): Double =
    if metric == Metric.Flip then 1.0
    else
      val sorted = map.data.sorted
      val percentile = sorted(Math.min(sorted.length - 1, sorted.length * 99 / 100))
      if percentile > 0 then percentile.toDouble else sorted.last.toDouble

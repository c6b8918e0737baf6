package candela.aov

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import candela.color.Rgb
import candela.film.{Development, ExactSums, PixelBounds, SplatFilm}
import candela.image.Image

/** Accumulators of the requested AOVs, in addition to [[candela.film.Film]]. Not synchronised
  * either: one worker at a time owns a pixel.
  *
  * Misses contribute to light, the albedo and the sample count only, as in pbrt-v4.
  *
  * @param groups names of the light groups, if the samples' light is divided
  */
final class LayerFilm(
    bounds: PixelBounds,
    layers: Vector[ImageLayer],
    groups: Option[Vector[String]] = None
):
  private val x0 = bounds.x0
  private val y0 = bounds.y0
  private val width = bounds.width
  private val height = bounds.height

  // Per pixel: sample count, total weight, weight of samples that hit a surface; then the tallies
  private val statistics = layers.map(_.statisticOf(groups.getOrElse(Vector.empty)))
  private val tallies = statistics.map(_.tally).distinct.toArray
  private val offsets = tallies.scanLeft(3)(_ + _.size)
  private val stride = offsets.last
  private val sums =
    ExactSums(Math.multiplyExact(stride, Math.multiplyExact(width, height)))

  /** Adds a sample to its pixel. */
  def add(x: Int, y: Int, light: Rgb, weight: Float, seen: VisibleSurface): Unit =
    miss(x, y, weight)
    val offset = first(x, y)
    val w = weight.toDouble
    if seen.isThere then sums.add(offset + 2, w)
    var i = 0
    while i < tallies.length do
      val tally = tallies(i)
      if seen.isThere || !tally.needsSurface then
        tally.add(sums, offset + offsets(i), w, light, seen)
      i += 1

  /** Adds a sample blocked by the camera. */
  def miss(x: Int, y: Int, weight: Float): Unit =
    val offset = first(x, y)
    sums.add(offset, 1)
    sums.add(offset + 1, weight)

  private def first(x: Int, y: Int): Int = stride * ((y - y0) * width + (x - x0))

  def save(to: CheckedOutput): Unit = sums.save(to)

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit =
    if !tallies.exists(_.joins) then sums.load(from)
    else
      val added = ExactSums(sums.size)
      added.load(from)
      loop(width * height): pixel =>
        loop(tallies.length)(i => tallies(i).join(sums, stride * pixel + offsets(i), added))
      sums.add(added)

  /** Appends the AOV channels to the image.
    *
    * @param development how the image was made
    * @param splats      of light paths, if any: light scattered more than once
    */
  def appendTo(image: Image, development: Development, splats: Option[SplatFilm] = None): Image =
    require(image.width == width && image.height == height)
    val names =
      image.channelNames ++ layers.flatMap(_.channelsOf(groups.getOrElse(Vector.empty)))
    val data = new Array[Float](names.size * width * height)
    val space = image.colorSpace
    def convert(layer: ImageLayer): Array[Double] => Array[Float] =
      if groups.isDefined && layer.isLight then
        own =>
          val values = own.map(_.toFloat)
          for at <- values.indices by 3 do development.color(values, at)
          values
      else if space.isSrgb then _.map(_.toFloat)
      else
        layer.to(space) match
          case Some(matrix) => own => (matrix * own.toVector).toArray.map(_.toFloat)
          case None => _.map(_.toFloat)
    val outputs = layers.indices.map: i =>
      (statistics(i), splatted(layers(i), splats, development.scale), convert(layers(i)))
    loop(width * height): pixel =>
      val from = image.channels * pixel
      var to = names.size * pixel
      System.arraycopy(image.data, from, data, to, image.channels)
      to += image.channels
      for (statistic, brought, converted) <- outputs do
        val raw = statistic(tallyOf(statistic, stride * pixel, development.scale))
        loop(brought.length): k =>
          loop(3)(c => raw(3 * k + c) += brought(k)(3 * pixel + c))
        val values = converted(raw)
        System.arraycopy(values, 0, data, to, values.length)
        to += values.length
    Image(width, height, names, data, colorSpace = space)

  /** What light paths bring to the layer's channels, three by three, if light is divided. */
  private def splatted(
      layer: ImageLayer,
      splats: Option[SplatFilm],
      scale: Float
  ): Array[Array[Float]] =
    def splatData(add: (SplatFilm, Array[Float]) => Unit): Array[Float] =
      val data = new Array[Float](3 * width * height)
      splats.foreach(add(_, data))
      data
    (layer, groups) match
      case (Layer.Indirect, Some(_)) if splats.isDefined =>
        Array(splatData((film, data) => film.addTo(data, scale)))
      case (Layer.Lights, Some(names)) if splats.isDefined =>
        Array.tabulate(names.size)(group =>
          splatData((film, data) => film.addTo(data, scale, group))
        )
      case (strategy: StrategyLayer, _) if strategy.isSplatted =>
        Array(splatData((film, data) => film.addStrategyTo(data, scale, strategy.depth - 1)))
      case _ => Array.empty

  private def tallyOf(statistic: Statistic, pixel: Int, scale: Float): PixelTally =
    val tally = statistic.tally
    val offset = pixel + offsets(tallies.indexOf(tally))
    PixelTally(sums, offset, tally.size, sums(pixel), sums(pixel + 1), sums(pixel + 2), scale)

object LayerFilm:
  /** Numbers of a pixel, while they are accumulated or in the image, whichever are more. */
  def size(layers: Vector[ImageLayer], groups: Option[Vector[String]]): Long =
    val names = groups.getOrElse(Vector.empty)
    val sums = 3L + layers.map(_.statisticOf(names).tally).distinct.map(_.size.toLong).sum
    Math.max(sums, 3L + layers.map(_.channelsOf(names).size.toLong).sum)

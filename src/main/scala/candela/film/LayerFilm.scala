package candela.film

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.integrators.VisibleSurface
import candela.math.Vec3

/** The sums for the layers that are asked for, beside those of [[Film]]; like it not synchronised,
  * a pixel belongs to one worker at a time.
  *
  * Samples that meet nothing count for the albedo and the number of samples only, as in pbrt-v4.
  */
final class LayerFilm(x0: Int, y0: Int, x1: Int, y1: Int, layers: Vector[Layer]):
  import Layer.*
  private val width = x1 - x0
  private val height = y1 - y0

  // A pixel has: samples, weight of all, weight of those that met a surface; then what is wanted
  private var stride = 3
  private def place(layer: Layer, numbers: Int): Int =
    if !layers.contains(layer) then -1
    else
      stride += numbers
      stride - numbers
  private val albedo = place(Albedo, 3)
  private val position = place(Position, 3)
  private val gradient = place(Gradient, 2)
  private val normal = place(Normal, 3)
  private val shadingNormal = place(ShadingNormal, 3)
  private val uv = place(Uv, 2)
  private val depth = place(Depth, 1)
  // How many, then the means, then the sums of squared deviations
  private val moments =
    if layers.contains(Variance) then place(Variance, 7) else place(RelativeVariance, 7)
  private val sums =
    new Array[Double](Math.multiplyExact(stride, Math.multiplyExact(width, height)))

  /** Adds a sample to its pixel. */
  def add(x: Int, y: Int, light: Rgb, weight: Float, seen: VisibleSurface): Unit =
    val at = stride * ((y - y0) * width + (x - x0))
    val w = weight.toDouble
    sums(at) += 1
    sums(at + 1) += w
    if seen.isThere then
      sums(at + 2) += w
      if albedo > 0 then
        sums(at + albedo) += w * seen.albedo.r
        sums(at + albedo + 1) += w * seen.albedo.g
        sums(at + albedo + 2) += w * seen.albedo.b
      if position > 0 then addVector(at + position, w, seen.p)
      if normal > 0 then addVector(at + normal, w, seen.n)
      if shadingNormal > 0 then addVector(at + shadingNormal, w, seen.shadingNormal)
      if gradient > 0 then
        sums(at + gradient) += w * seen.dzdx
        sums(at + gradient + 1) += w * seen.dzdy
      if uv > 0 then
        sums(at + uv) += w * seen.u
        sums(at + uv + 1) += w * seen.v
      if depth > 0 then sums(at + depth) += w * seen.depth
      if moments > 0 then
        sums(at + moments) += 1
        deviate(at + moments, 0, light.r)
        deviate(at + moments, 1, light.g)
        deviate(at + moments, 2, light.b)

  /** Adds a sample that the camera blocks. */
  def miss(x: Int, y: Int, weight: Float): Unit =
    val at = stride * ((y - y0) * width + (x - x0))
    sums(at) += 1
    sums(at + 1) += weight

  private def addVector(at: Int, w: Double, v: Vec3): Unit =
    sums(at) += w * v.x
    sums(at + 1) += w * v.y
    sums(at + 2) += w * v.z

  /** Welford, "Note on a method for calculating corrected sums of squares and products",
    * Technometrics 4(3), 1962.
    */
  private def deviate(at: Int, c: Int, value: Float): Unit =
    val before = value - sums(at + 1 + c)
    sums(at + 1 + c) += before / sums(at)
    sums(at + 4 + c) += before * (value - sums(at + 1 + c))

  /** The image with the layers behind its own channels.
    *
    * @param scale of the samples that were added, to be those of the image
    */
  def behind(image: Image, scale: Float): Image =
    require(image.width == width && image.height == height)
    val names = image.channelNames ++ layers.flatMap(_.channels)
    val data = new Array[Float](names.size * width * height)
    loop(width * height): pixel =>
      val from = image.channels * pixel
      var to = names.size * pixel
      System.arraycopy(image.data, from, data, to, image.channels)
      to += image.channels
      for layer <- layers do
        val values = read(layer, stride * pixel, scale)
        loop(values.length)(i => data(to + i) = values(i).toFloat)
        to += values.length
    Image(width, height, names, data)

  private def read(layer: Layer, at: Int, scale: Double): Array[Double] = layer match
    case Albedo => mean(at + albedo, 3, sums(at + 1))
    case Position => mean(at + position, 3, sums(at + 2))
    case Gradient => mean(at + gradient, 2, sums(at + 2)).map(Math.abs)
    case Normal => unit(at + normal)
    case ShadingNormal => unit(at + shadingNormal)
    case Uv => mean(at + uv, 2, sums(at + 2))
    case Depth => mean(at + depth, 1, sums(at + 2))
    case Samples => Array(sums(at))
    case Variance => Array.tabulate(3)(variance(at + moments, _) * scale * scale)
    case RelativeVariance =>
      Array.tabulate(3): c =>
        val mean = sums(at + moments + 1 + c)
        if mean == 0 then 0.0 else variance(at + moments, c) / mean * scale

  private def variance(at: Int, c: Int): Double =
    if sums(at) > 1 then sums(at + 4 + c) / (sums(at) - 1) else 0.0

  private def mean(at: Int, count: Int, weight: Double): Array[Double] =
    Array.tabulate(count)(i => if weight != 0 then sums(at + i) / weight else 0.0)

  private def unit(at: Int): Array[Double] =
    val v = Array.tabulate(3)(i => sums(at + i))
    val length = Math.sqrt(v.map(x => x * x).sum)
    if length > 0 then v.map(_ / length) else v

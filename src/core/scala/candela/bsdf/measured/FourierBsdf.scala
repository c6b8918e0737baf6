package candela.bsdf.measured

import candela.bsdf.{Bsdf, BsdfFlags, BsdfSample, Hemisphere}
import candela.color.Rgb
import candela.math.*

/** Tabulated scattering: for each pair of elevations a Fourier series f·|cos θi| in the azimuth
  * difference.
  *
  * @param cosines      ascending from −1 to 1: of the light's propagation direction, and of `wo`
  * @param offsets      index of the first coefficient, by cosine of `wo`, then by cosine of the
  *                     light
  * @param counts       number of coefficients of each series, per channel
  * @param coefficients luminance; with three channels, red and blue follow
  * @param eta          index of refraction below the surface over that above
  */
final class FourierTable(
    val cosines: Array[Float],
    offsets: Array[Int],
    counts: Array[Int],
    coefficients: Array[Float],
    val channels: Int,
    val eta: Float
):
  private val size = cosines.length

  /** Maximum number of coefficients per channel. */
  val order: Int = counts.max

  /** Azimuthal average of each series. */
  val means: Array[Float] =
    Array.tabulate(size * size)(i => if counts(i) > 0 then coefficients(offsets(i)) else 0f)

  /** Integral of the averages over the light's cosine, by cosine of `wo`. */
  val sums: Array[Float] =
    means.grouped(size).map(CatmullRom.integrals(cosines, _).last).toArray

  /** Interpolates the coefficients between the cosines into `to`, channels [[order]] apart.
    *
    * @return number of coefficients; 0 if the cosines are outside the table
    */
  def series(light: Float, eye: Float, to: Array[Float]): Int =
    val lightWeights = new Array[Float](4)
    val eyeWeights = new Array[Float](4)
    val lightFirst = CatmullRom.weights(cosines, light, lightWeights)
    val eyeFirst = CatmullRom.weights(cosines, eye, eyeWeights)
    if lightFirst == CatmullRom.Outside || eyeFirst == CatmullRom.Outside then 0
    else
      var maxCount = 0
      var o = 0
      while o < 4 do
        var i = 0
        while i < 4 do
          val weight = eyeWeights(o) * lightWeights(i)
          if weight != 0f then
            val pair = (eyeFirst + o) * size + lightFirst + i
            add(pair, weight, to)
            maxCount = Math.max(maxCount, counts(pair))
          i += 1
        o += 1
      maxCount

  private def add(pair: Int, weight: Float, to: Array[Float]): Unit =
    val count = counts(pair)
    var c = 0
    while c < channels do
      val start = offsets(pair) + c * count
      val target = c * order
      var k = 0
      while k < count do
        to(target + k) += weight * coefficients(start + k)
        k += 1
      c += 1

/** BSDF of a [[FourierTable]].
  *
  * Source: Jakob, d'Eon, Jakob, Marschner, "A Comprehensive Framework for Rendering Layered
  * Materials", SIGGRAPH 2014; PBRT 3rd ed., §8.6 and §14.1.4.
  */
final class FourierBsdf(table: FourierTable) extends Bsdf:
  private val order = table.order

  def f(wo: Vec3, wi: Vec3): Rgb =
    val series = new Array[Float](order * table.channels)
    val count = table.series(clamp(-wi.z, -1f, 1f), clamp(wo.z, -1f, 1f), series)
    if count == 0 || Hemisphere.isLevel(wo, wi) then Rgb.Black
    else color(series, count, FourierBsdf.cosPhi(wi, wo)) * (1f / scale(wo, wi))

  /** Divisor from the tabulated f·|cos| to f; includes the change of solid angle on refraction. */
  private def scale(wo: Vec3, wi: Vec3): Float =
    val cosine = Hemisphere.absCos(wi)
    if wo.z * wi.z >= 0f then cosine else cosine * square(relativeEta(wo))

  /** Index of refraction on the other side over that on the side of `wo`. */
  private def relativeEta(wo: Vec3): Float = if wo.z < 0f then 1f / table.eta else table.eta

  private def color(series: Array[Float], count: Int, cosPhi: Float): Rgb =
    val y = Math.max(0f, FourierSeries.value(series, 0, count, cosPhi))
    if table.channels == 1 then Rgb.gray(y)
    else
      val r = FourierSeries.value(series, order, count, cosPhi)
      val b = FourierSeries.value(series, 2 * order, count, cosPhi)
      val g = FourierBsdf.green(y, r, b)
      Rgb(Math.max(0f, r), Math.max(0f, g), Math.max(0f, b))

  def pdf(wo: Vec3, wi: Vec3): Float =
    val series = new Array[Float](order * table.channels)
    val count = table.series(clamp(-wi.z, -1f, 1f), clamp(wo.z, -1f, 1f), series)
    if count == 0 then 0f else density(series, count, FourierBsdf.cosPhi(wi, wo), wo)

  private def density(series: Array[Float], count: Int, cosPhi: Float, wo: Vec3): Float =
    val integral = CatmullRom.value(table.cosines, table.sums, clamp(wo.z, -1f, 1f)) * TwoPi
    val y = FourierSeries.value(series, 0, count, cosPhi)
    if integral > 0f && y > 0f then y / integral else 0f

  def sample(wo: Vec3, choice: Float, u1: Float, u2: Float): BsdfSample =
    val eye = clamp(wo.z, -1f, 1f)
    val cosines = table.cosines
    val means = CatmullRom.row(cosines, table.means, eye)
    val sums = CatmullRom.integrals(cosines, means)
    if !(sums(sums.length - 1) > 0f) then BsdfSample.Absorbed
    else
      val light = CatmullRom.sample(cosines, means, sums, u2)
      val series = new Array[Float](order * table.channels)
      val count = table.series(light, eye, series)
      if count == 0 || !(series(0) > 0f) || light == 0f then BsdfSample.Absorbed
      else buildSample(wo, light, FourierSeries.sample(series, count, u1), series, count)

  private def buildSample(
      wo: Vec3,
      light: Float,
      phi: Float,
      series: Array[Float],
      count: Int
  ): BsdfSample =
    val c = cos(phi)
    val s = sin(phi)
    val sinO = sqrt(wo.x * wo.x + wo.y * wo.y)
    val x = if sinO > 0f then wo.x / sinO else 1f
    val y = if sinO > 0f then wo.y / sinO else 0f
    val r = safeSqrt(1f - light * light)
    val wi = Vec3(-r * (c * x - s * y), -r * (s * x + c * y), -light).normalized
    val pdf = density(series, count, c, wo)
    if !(pdf > 0f) then BsdfSample.Absorbed
    else
      val isRefracted = wo.z * wi.z < 0f
      val eta = if isRefracted then relativeEta(wo) else 1f
      val weight = color(series, count, c) * (1f / (pdf * eta * eta))
      BsdfSample(wi, weight, pdf, isSpecular = false, eta)

  def flags: BsdfFlags =
    BsdfFlags.Glossy | BsdfFlags.Transmissive | BsdfFlags.NonReciprocal | BsdfFlags.Choosing

object FourierBsdf:
  /** Cosine of the azimuth between the light's propagation direction and `wo`. */
  private def cosPhi(wi: Vec3, wo: Vec3): Float =
    val lengths = (wi.x * wi.x + wi.y * wi.y) * (wo.x * wo.x + wo.y * wo.y)
    if lengths == 0f then 1f
    else clamp(-(wi.x * wo.x + wi.y * wo.y) / sqrt(lengths), -1f, 1f)

  /** Green from luminance, red and blue, for the sRGB primaries. */
  def green(y: Float, r: Float, b: Float): Float = 1.39829f * y - 0.100913f * b - 0.297375f * r

package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.math.*
import candela.sampling.{Distribution2D, Warp}

/** The same radiance from all directions.
  *
  * @param complete must `sample` find it? If not it is left to BSDF sampling, which serves a
  *                 uniform light at least as well and costs no shadow ray
  */
final class ConstantEnvironment(emitted: Rgb, complete: Boolean) extends EnvironmentLight:
  override def isSampled: Boolean = complete && !emitted.isBlack
  def radiance(d: Vec3): Rgb = emitted
  def pdf(d: Vec3): Float = if isSampled then 1f / (4f * Pi) else 0f

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.wi = Warp.uniformSphere(u1, u2)
    out.radiance = emitted
    out.pdf = pdf(out.wi)
    out.isInfinite = true

/** Radiance from an image around the scene.
  *
  * @param image    red, green, blue, linear
  * @param layout   how it covers the sphere, in light space
  * @param factor   of the image's values
  * @param smooth   bilinear between pixel centres (pbrt-v2, v3), or each pixel of one colour (v4)
  * @param complete must `sample` reach every bright pixel? If not, pixels darker than the mean are
  *                 left to BSDF sampling (Karlík et al., "MIS Compensation: Optimizing Sampling
  *                 Techniques in Multiple Importance Sampling", TOG 38(6), 2019)
  */
final class ImageEnvironment(
    lightToWorld: Transform,
    image: Image,
    layout: SphereMap,
    factor: Rgb,
    smooth: Boolean,
    complete: Boolean
) extends EnvironmentLight:
  private val (width, height) = (image.width, image.height)
  private val data: Array[Float] =
    val d = image.data.clone()
    loop(width * height): i =>
      d(3 * i) *= factor.r
      d(3 * i + 1) *= factor.g
      d(3 * i + 2) *= factor.b
    d

  /** Rotations both ways, as rows; directions are renormalised in case the transform scales. */
  private val toWorldM = lightToWorld.m.map(_.toFloat)
  private val toLightM = lightToWorld.inverseM.map(_.toFloat)

  private val distribution: Distribution2D =
    // Weight of a pixel: its mean radiance times its solid angle
    val w = new Array[Float](width * height)
    loop(height): y =>
      val share = layout.stretch((y + 0.5f) / height)
      loop(width)(x => w(y * width + x) = meanOver(x, y) * share)
    if !complete then
      val mean = (w.foldLeft(0.0)(_ + _) / w.length).toFloat
      val above = w.map(v => Math.max(0f, v - mean))
      if above.exists(_ > 0f) then Distribution2D(above, width, height)
      else Distribution2D(w, width, height)
    else Distribution2D(w, width, height)

  override def isSampled: Boolean = distribution.integral > 0.0

  /** Of `radiance` over the pixel: what bilinear lookups within it average to. */
  private def meanOver(x: Int, y: Int): Float =
    if !smooth then brightness(pixel(x, y))
    else
      var sum = 0f
      loop(9): k =>
        val (i, j) = (k % 3 - 1, k / 3 - 1)
        sum += ImageEnvironment.Tent(k) * brightness(pixel(x + i, y + j))
      sum

  private def brightness(at: Int): Float = (data(at) + data(at + 1) + data(at + 2)) * (1f / 3f)

  private def rotate(m: IArray[Float], v: Vec3): Vec3 =
    Vec3(
      m(0) * v.x + m(1) * v.y + m(2) * v.z,
      m(4) * v.x + m(5) * v.y + m(6) * v.z,
      m(8) * v.x + m(9) * v.y + m(10) * v.z
    ).normalized

  def radiance(d: Vec3): Rgb = at(layout.toImage(rotate(toLightM, d)))

  private def at(place: Vec3): Rgb =
    if smooth then between(place)
    else
      val x = Math.min((place.x * width).toInt, width - 1)
      val first = 3 * (Math.min((place.y * height).toInt, height - 1) * width + x)
      Rgb(data(first), data(first + 1), data(first + 2))

  private def between(place: Vec3): Rgb =
    val fx = place.x * width - 0.5f
    val fy = place.y * height - 0.5f
    val x = Math.floor(fx).toInt
    val y = Math.floor(fy).toInt
    val (tx, ty) = (fx - x, fy - y)
    val a = pixel(x, y)
    val b = pixel(x + 1, y)
    val c = pixel(x, y + 1)
    val e = pixel(x + 1, y + 1)
    Rgb(
      mix(a, b, c, e, 0, tx, ty),
      mix(a, b, c, e, 1, tx, ty),
      mix(a, b, c, e, 2, tx, ty)
    )

  private def pixel(x: Int, y: Int): Int =
    3 * (layout.wrapY(x, y, width, height) * width + layout.wrapX(x, y, width, height))

  private def mix(a: Int, b: Int, c: Int, d: Int, channel: Int, tx: Float, ty: Float): Float =
    lerp(
      ty,
      lerp(tx, data(a + channel), data(b + channel)),
      lerp(tx, data(c + channel), data(d + channel))
    )

  def pdf(d: Vec3): Float =
    val place = layout.toImage(rotate(toLightM, d))
    val s = layout.stretch(place.y)
    if s > 0f then distribution.pdf(place.x, place.y) / s else 0f

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val place = distribution.sample(u1, u2)
    val s = layout.stretch(place.y)
    out.wi = rotate(toWorldM, layout.toDirection(place.x, place.y))
    // Within a pixel of one colour the place needs no way back from the direction
    out.radiance = if smooth then radiance(out.wi) else at(place)
    out.pdf = if s > 0f then place.z / s else 0f
    out.isInfinite = true

object ImageEnvironment:
  /** What each pixel of a 3×3 neighbourhood adds to the mean of bilinear lookups in the middle one:
    * the products of 1/8, 3/4, 1/8.
    */
  private val Tent: Array[Float] =
    val side = Array(0.125f, 0.75f, 0.125f)
    Array.tabulate(9)(k => side(k % 3) * side(k / 3))

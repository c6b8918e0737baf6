package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.math.*
import candela.sampling.{Distribution2D, Warp}

/** Uniform infinite light.
  *
  * @param complete whether `sample` must find the light; if false, only BSDF sampling does, which
  *   serves a uniform light at least as well and saves a shadow ray
  */
final class ConstantEnvironment(emitted: Rgb, complete: Boolean) extends EnvironmentLight:
  override def isSampled: Boolean = complete && !emitted.isBlack
  def radiance(from: Vec3, d: Vec3): Rgb = emitted
  def pdf(from: Vec3, d: Vec3): Float = if isSampled then 1f / (4f * Pi) else 0f
  protected def total: Float = if isSampled then 4f * Pi * emitted.max else 0f

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.wi = Warp.uniformSphere(u1, u2)
    out.radiance = emitted
    out.pdf = pdf(from, out.wi)
    out.isInfinite = true

/** Infinite light with an environment map.
  *
  * @param distribution of its directions, over the image
  */
final class ImageEnvironment(
    frame: LightFrame,
    image: SphereImage,
    distribution: Distribution2D
) extends EnvironmentLight:
  private val layout = image.layout

  override def isSampled: Boolean = distribution.integral > 0.0
  protected def total: Float = distribution.integral.toFloat

  def radiance(from: Vec3, d: Vec3): Rgb = image(frame.toLight(d))

  def pdf(from: Vec3, d: Vec3): Float =
    val uv = layout.toImage(frame.toLight(d))
    val s = layout.stretch(uv.y)
    if s > 0f then distribution.pdf(uv.x, uv.y) / s else 0f

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val uv = distribution.sample(u1, u2)
    val s = layout.stretch(uv.y)
    out.wi = frame.toWorld(layout.toDirection(uv.x, uv.y))
    out.defer(this, uv)
    out.pdf = if s > 0f then uv.z / s else 0f
    out.isInfinite = true

  /** Radiance of a sampled direction, from its place in the image. With constant pixels, the place
    * saves mapping the direction back.
    */
  private[lights] def radianceAt(place: Vec3, wi: Vec3): Rgb =
    if image.smooth then image(frame.toLight(wi)) else image.colorAt(place)

object ImageEnvironment:
  /** @param complete see [[distribution]] */
  def apply(frame: LightFrame, image: SphereImage, complete: Boolean): ImageEnvironment =
    new ImageEnvironment(frame, image, distribution(image, complete))

  /** Weight of a pixel: its mean radiance times its solid angle.
    *
    * @param complete whether `sample` must reach every non-black pixel; if false, pixels darker
    *   than the mean are left to BSDF sampling (Karlík et al., "MIS Compensation: Optimizing
    *   Sampling Techniques in Multiple Importance Sampling", TOG 38(6), 2019)
    */
  def distribution(image: SphereImage, complete: Boolean): Distribution2D =
    val width = image.width
    val height = image.height
    val shares = Array.tabulate(height)(image.layout.share(_, height))
    // Of a hundred million pixels closures would make boxes
    val bright = image.brightness
    var sum = 0.0
    loop(bright.length)(i => sum += Math.max(0f, bright(i)) * shares(i / width))
    val mean = (sum / (shares.foldLeft(0.0)(_ + _) * width)).toFloat
    def above(least: Float): Boolean =
      var i = 0
      while i < bright.length && !(Math.max(0f, bright(i) - least) * shares(i / width) > 0f) do
        i += 1
      i < bright.length
    val floor = if !complete && above(mean) then mean else 0f
    loop(bright.length)(i => bright(i) = Math.max(0f, bright(i) - floor) * shares(i / width))
    Distribution2D(bright, width, height)

package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.geometry.{Ball, Frame}
import candela.image.Image
import candela.math.*
import candela.sampling.WindowedDistribution2D

/** Infinite light with an environment map, visible through a rectangular portal only.
  *
  * The image is resampled so that straight lines parallel to the portal's sides become its rows and
  * columns. A point then sees the portal as a rectangle of the image, and samples just that.
  *
  * Source: Bitterli, Novák, Jarosz, "Portal-Masked Environment Map Sampling", CGF 34(4), 2015; PBRT
  * 4th ed., §12.5.3.
  *
  * @param corner       a corner of the portal, in world space
  * @param opposite     the opposite corner
  * @param window       the portal's frame, with sides along `s` and `t`; the light is on the side
  *                     of `n`
  * @param rectified    the rectified environment map
  * @param distribution of its positions
  */
final class PortalEnvironment private (
    corner: Vec3,
    opposite: Vec3,
    window: Frame,
    rectified: Picture,
    distribution: WindowedDistribution2D
) extends EnvironmentLight:
  import PortalEnvironment.{density, direction}

  /** The same light with converted colours. */
  def converted(colors: Rgb => Rgb): PortalEnvironment =
    new PortalEnvironment(corner, opposite, window, rectified.converted(colors), distribution)

  override def isSampled: Boolean = distribution.integral(0f, 0f, 1f, 1f) > 0

  /** The power admitted depends on the receiving point. */
  protected def total: Float = 0f
  override def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float = 0f

  private def coordinate(along: Float, z: Float): Float =
    clamp(Math.atan2(along.toDouble, z.toDouble).toFloat * InvPi + 0.5f, 0f, 1f)

  /** Passes the rectangle (x0, y0, x1, y1) of the image that `from` sees through the portal to
    * `use`; `none` if the portal faces away.
    */
  private inline def withRectangle[A](from: Vec3, none: A)(
      inline use: (Float, Float, Float, Float) => A
  ): A =
    val a = window.toLocal(corner - from)
    val b = window.toLocal(opposite - from)
    if !(a.z > 0f && b.z > 0f) then none
    else
      val ax = coordinate(a.x, a.z)
      val ay = coordinate(a.y, a.z)
      val bx = coordinate(b.x, b.z)
      val by = coordinate(b.y, b.z)
      use(Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by))

  def radiance(from: Vec3, d: Vec3): Rgb =
    val w = window.toLocal(d)
    if w.z <= 0f then Rgb.Black
    else
      val x = coordinate(w.x, w.z)
      val y = coordinate(w.y, w.z)
      withRectangle(from, Rgb.Black): (x0, y0, x1, y1) =>
        if x < x0 || x > x1 || y < y0 || y > y1 then Rgb.Black else rectified(x, y)

  def pdf(from: Vec3, d: Vec3): Float =
    val w = window.toLocal(d)
    if w.z <= 0f then 0f
    else
      val x = coordinate(w.x, w.z)
      val y = coordinate(w.y, w.z)
      withRectangle(from, 0f): (x0, y0, x1, y1) =>
        distribution.pdf(x, y, x0, y0, x1, y1) * density(w)

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.pdf = 0f
    out.isInfinite = true
    val imageSample = withRectangle(from, Vec3.Zero): (x0, y0, x1, y1) =>
      distribution.sample(u1, u2, x0, y0, x1, y1)
    if imageSample.z > 0f then
      out.wi = direction(window, imageSample.x, imageSample.y)
      out.radiance = rectified(imageSample.x, imageSample.y)
      out.pdf = imageSample.z * density(window.toLocal(out.wi))

object PortalEnvironment:

  /** @param frame orientation of the image */
  def apply(
      frame: LightFrame,
      image: SphereImage,
      corner: Vec3,
      opposite: Vec3,
      window: Frame
  ): PortalEnvironment =
    val width = image.width
    val height = image.height
    val drawn = Image.rgb(width, height)
    loop(width * height): i =>
      val towards = direction(window, (i % width + 0.5f) / width, (i / width + 0.5f) / height)
      val c = image.bilinear(image.layout.toImage(frame.toLight(towards)))
      drawn.data(3 * i) = Math.max(0f, c.r)
      drawn.data(3 * i + 1) = Math.max(0f, c.g)
      drawn.data(3 * i + 2) = Math.max(0f, c.b)
    val rectified = Picture(drawn, PictureLookup.Nearest)
    val weights = Array.tabulate(width * height): i =>
      val x = (i % width + 0.5f) / width
      val y = (i / width + 0.5f) / height
      rectified(x, y).average / density(window.toLocal(direction(window, x, y)))
    val distribution = WindowedDistribution2D(weights, width, height)
    new PortalEnvironment(corner, opposite, window, rectified, distribution)

  /** World direction of a position in the rectified image. */
  private def direction(window: Frame, x: Float, y: Float): Vec3 =
    val a = Math.tan((x - 0.5) * Math.PI).toFloat
    val b = Math.tan((y - 0.5) * Math.PI).toFloat
    window.toWorld(Vec3(a, b, 1f).normalized)

  /** Image area per steradian at the direction `w` of the portal's frame. */
  private def density(w: Vec3): Float =
    InvPi * InvPi * w.z / ((1f - w.x * w.x) * (1f - w.y * w.y))

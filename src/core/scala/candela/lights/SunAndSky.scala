package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.geometry.Frame
import candela.image.Image
import candela.math.*
import candela.sampling.Warp

/** A clear sky above the horizon (+z of light space), with a uniform disk as its sun.
  *
  * @param toSun    unit, in light space, above the horizon
  * @param halfSize half of the angle that the sun subtends, in radians
  * @param sky      scale of the sky's radiance
  * @param sunlight irradiance by the sun on a plane that faces it
  * @param convert  from linear sRGB to the scene's basis
  * @param complete see [[ImageEnvironment.distribution]]
  */
final class SunAndSky(
    frame: LightFrame,
    model: SkyModel,
    toSun: Vec3,
    halfSize: Float,
    sky: Float,
    sunlight: Rgb,
    convert: Rgb => Rgb,
    complete: Boolean,
    override val isInView: Boolean = true
) extends EnvironmentLight:
  private val sunFrame = Frame.fromZ(toSun)

  /** 1 − cos of the sun's half-angle. */
  private val spread = 2f * square(Math.sin(halfSize / 2.0).toFloat)
  private val sunPdf = Warp.uniformConePdf(spread)
  private val disk = sunlight * sunPdf

  private val distribution =
    val picture =
      SunAndSky.picture(model, toSun, 2 * SunAndSky.Rows, SunAndSky.Rows, LatLongMap, parts = 1)
    ImageEnvironment.distribution(
      SphereImage(picture, LatLongMap, Rgb.gray(sky), smooth = false),
      complete
    )

  /** Probability of sampling the sun: its share of the irradiance, of which the sky loses about
    * half by the cosine.
    */
  private val sunShare =
    val direct = Math.max(0f, sunlight.average)
    val diffuse = (distribution.integral / 2).toFloat
    if direct + diffuse > 0f then direct / (direct + diffuse) else 0f

  protected def total: Float =
    distribution.integral.toFloat + Math.max(0f, sunlight.max)

  def radiance(from: Vec3, d: Vec3): Rgb = inLight(frame.toLight(d))

  private def inLight(d: Vec3): Rgb =
    if d.z < 0f then Rgb.Black else convert(above(d, isSun = hitsSun(d)))

  private def above(d: Vec3, isSun: Boolean): Rgb =
    val diffuse = if sky > 0f then model.radiance(d.z, d dot toSun) * sky else Rgb.Black
    if isSun then diffuse + disk else diffuse

  // |d − s|² = 2 (1 − cos), without the rounding of a cosine close to 1
  private def hitsSun(d: Vec3): Boolean = (d - toSun).lengthSquared <= 2f * spread

  def pdf(from: Vec3, d: Vec3): Float =
    val inside = frame.toLight(d)
    pdf(inside, hitsSun(inside))

  private def pdf(d: Vec3, isSun: Boolean): Float =
    if d.z < 0f then 0f
    else
      val uv = LatLongMap.toImage(d)
      val s = LatLongMap.stretch(uv.y)
      val ofSky = if s > 0f then distribution.pdf(uv.x, uv.y) / s else 0f
      (1f - sunShare) * ofSky + (if isSun then sunShare * sunPdf else 0f)

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val isSun = u1 < sunShare
    val d =
      if isSun then sunFrame.toWorld(Warp.uniformCone(u1 / sunShare, u2, spread))
      else
        val uv = distribution.sample((u1 - sunShare) / (1f - sunShare), u2)
        LatLongMap.toDirection(uv.x, uv.y)
    val hits = isSun || hitsSun(d)
    out.wi = frame.toWorld(d)
    out.radiance = if d.z < 0f then Rgb.Black else convert(above(d, hits))
    out.pdf = pdf(d, hits)
    out.isInfinite = true

object SunAndSky:
  /** Rows of the table of directions. */
  private val Rows = 256

  /** The sky without its sun; each pixel is the mean of `parts` × `parts` directions. If these are
    * several, none is on a diagonal, where equal-area maps have the horizon.
    */
  def picture(
      model: SkyModel,
      toSun: Vec3,
      width: Int,
      height: Int,
      layout: SphereMap,
      parts: Int
  ): Image =
    val result = Image.rgb(width, height)
    val data = result.data
    loop(width * height): i =>
      loop(parts * parts): part =>
        val across = (part % parts + 0.5f) / parts
        val down = (part / parts + across) / parts
        val d = layout.toDirection((i % width + across) / width, (i / width + down) / height)
        if d.z >= 0f then
          val c = model.radiance(d.z, d dot toSun) * (1f / (parts * parts))
          data(3 * i) += Math.max(0f, c.r)
          data(3 * i + 1) += Math.max(0f, c.g)
          data(3 * i + 2) += Math.max(0f, c.b)
    result

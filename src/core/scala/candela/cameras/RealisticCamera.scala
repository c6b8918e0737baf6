package candela.cameras

import candela.geometry.Ray
import candela.math.*

/** Camera with a simulated lens system and a film of some centimetres; the scene's unit is the
  * metre.
  *
  * A ray's weight turns the mean over samples into the film's measurement: cos⁴θ of the angle
  * between the axis and the ray to the rear element, times the area over which it was sampled. Rays
  * that hit a lens rim have weight 0, which causes vignetting.
  *
  * @param lens  the focused lens system
  * @param pupil exit pupil of the lens system
  * @param gain  weight of a ray per square metre of the pupil's rectangle, without cos⁴θ
  *
  * Source: Kolb et al. 1995, as [[LensSystem]], equation 4; PBRT 4th ed., §5.4.7.
  */
final class RealisticCamera(
    cameraToWorld: Transform,
    frame: FilmFrame,
    lens: LensSystem,
    pupil: ExitPupil,
    gain: Double
) extends Camera:
  private val aspect = frame.height.toDouble / frame.width
  private val filmWidth = frame.diagonal / Math.sqrt(1 + aspect * aspect)
  private val stepX = filmWidth / frame.width
  private val stepY = filmWidth * aspect / frame.height

  /** Relative to the film's exposure of a second. */
  def relativeGain: Double = gain / RealisticCamera.exposureGain(lens, 1)

  override def weighs: Boolean = true
  override protected[cameras] def step: Float = 0.05f

  def generate(x: Float, y: Float, lensU: Float, lensV: Float, ray: Ray): Unit =
    // The image on the film is upside down and reversed left to right
    val filmX = 0.5 * filmWidth - x * stepX
    val filmY = y * stepY - 0.5 * filmWidth * aspect
    val radius = Math.sqrt(filmX * filmX + filmY * filmY)
    val ring = pupil.ring(radius)
    ray.weight = 0f
    if !pupil.isDark(ring) then
      val px = pupil.x(ring, lensU)
      val py = pupil.y(ring, lensV)
      val c = if radius > 0 then filmX / radius else 1.0
      val s = if radius > 0 then filmY / radius else 0.0
      val path = ray.space
      path(0) = filmX
      path(1) = filmY
      path(2) = 0
      path(3) = c * px - s * py - filmX
      path(4) = s * px + c * py - filmY
      path(5) = lens.rearZ
      val cosine2 = path(5) * path(5) / (path(3) * path(3) + path(4) * path(4) + path(5) * path(5))
      val passed = lens.fromFilm(path)
      if passed > 0 then
        ray.weight = (passed * cosine2 * cosine2 * pupil.area(ring) * gain).toFloat
        val o = cameraToWorld.point(Vec3(path(0).toFloat, path(1).toFloat, path(2).toFloat))
        val d = cameraToWorld.vector(Vec3(path(3).toFloat, path(4).toFloat, path(5).toFloat))
        ray.set(o, d.normalized, Float.PositiveInfinity)

object RealisticCamera:
  /** Gain in W·s/m² per unit of radiance: the film's exposure in `seconds`. */
  def exposureGain(lens: LensSystem, seconds: Double): Double =
    seconds / (lens.rearZ * lens.rearZ)

  /** Gain that makes the image centre about as bright as with other cameras, as in pbrt-v3. */
  def relativeGain(pupil: ExitPupil): Double =
    if pupil.isDark(0) then 0.0 else 1 / pupil.central()

package candela.convert

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.lights.EqualAreaMap
import candela.math.*

/** A disk at infinity, above the horizon (+z), as an equal-area map: pbrt has no such light. */
private[convert] object SunImage:
  private val Side = 2048

  /** Root of a pixel's solid angle, in radians. */
  val PixelAngle: Float = (Math.sqrt(4 * Math.PI) / Side).toFloat

  /** Directions per pixel along each axis. */
  private val SamplesAcross = 8

  /** The map, whose largest component is 1, and its scale. Pixels at the edge have the share of the
    * disk that they contain; the irradiance is exact.
    *
    * @param toSun      unit vector to the centre
    * @param aperture   angular diameter in degrees
    * @param irradiance by the whole disk on a plane that faces it
    */
  def apply(toSun: Vec3, aperture: Float, irradiance: Rgb): (Image, Float) =
    val radius = (2 * Math.sin(Math.toRadians(aperture / 4.0))).toFloat // as a chord
    val color = irradiance * (1f / irradiance.max)
    val image = Image.rgb(Side, Side)
    var covered = 0L // by the disk, also below the horizon
    loop(Side): y =>
      loop(Side): x =>
        val centre = EqualAreaMap.toDirection((x + 0.5f) / Side, (y + 0.5f) / Side)
        if (centre - toSun).length < radius + 2 * PixelAngle then
          var lit = 0
          loop(SamplesAcross * SamplesAcross): k =>
            // No direction is on a diagonal of the map, where the horizon is
            val (i, j) = (k % SamplesAcross, k / SamplesAcross)
            val d = EqualAreaMap.toDirection(
              (x + (i + 0.5f) / SamplesAcross) / Side,
              (y + (j + (i + 0.5f) / SamplesAcross) / SamplesAcross) / Side
            )
            if (d - toSun).length <= radius then
              covered += 1
              if d.z >= 0f then lit += 1
          val share = lit.toFloat / (SamplesAcross * SamplesAcross)
          val offset = 3 * (y * Side + x)
          image.data(offset) = color.r * share
          image.data(offset + 1) = color.g * share
          image.data(offset + 2) = color.b * share
    val solidAngle = covered * 4 * Math.PI / (Side.toDouble * Side * SamplesAcross * SamplesAcross)
    (image, (irradiance.max / solidAngle).toFloat)

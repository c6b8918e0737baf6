package candela.lights

import candela.base.loop
import candela.color.Rgb

import scala.io.{Codec, Source}

/** Radiance of a clear sky and irradiance by its sun, as linear sRGB in Mitsuba's scale.
  *
  * Source: Hošek and Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance", TOG 31(4),
  * 2012, and "Adding a Solar-Radiance Function to the Hošek-Wilkie Skylight Model", CG&A 33(3),
  * 2013.
  *
  * @param turbidity of the air, from 1 (clearest) to 10
  * @param albedo    of the ground, from 0 to 1
  * @param elevation of the sun, in radians, from 0 to π / 2
  */
final class SkyModel(turbidity: Float, albedo: Rgb, elevation: Float):
  import SkyModel.*

  /** For red, green and blue: nine coefficients and the mean radiance. */
  private val rows: Array[Array[Double]] =
    // The control points of quintic Bézier curves lie closer to the horizon
    val x = Math.cbrt(2 * elevation / Math.PI)
    val weights = Array.tabulate(Points)(k =>
      Binomials(k) * Math.pow(x, k) * Math.pow(1 - x, Points - 1 - k)
    )
    Array(albedo.r, albedo.g, albedo.b).zipWithIndex.map: (ground, channel) =>
      Array.tabulate(Terms): term =>
        var sum = 0.0
        loop(Points): k =>
          def coefficient(t: Int, a: Int) = sky(((t * 2 + a) * 3 + channel) * Points + k)(term)
          def atAlbedo(a: Int) = interpolated(turbidity - 1, Levels)(coefficient(_, a))
          sum += weights(k) * (atAlbedo(0) * (1 - ground) + atAlbedo(1) * ground)
        sum

  /** Irradiance by the sun on a plane that faces it. */
  val sunIrradiance: Rgb =
    val position = ((Math.toDegrees(elevation) - FirstElevation) / ElevationStep).toFloat
    def channel(c: Int) = interpolated(turbidity - 1, Levels): t =>
      interpolated(position, Elevations)(e => sun(t * Elevations + e)(c))
    Rgb(channel(0).toFloat, channel(1).toFloat, channel(2).toFloat)

  /** Radiance of the sky from above the horizon.
    *
    * @param cosZenith cosine of the angle to the zenith, not negative
    * @param cosSun    cosine of the angle to the sun
    */
  def radiance(cosZenith: Float, cosSun: Float): Rgb =
    val gamma = Math.acos(Math.max(-1.0, Math.min(1.0, cosSun.toDouble)))
    val root = Math.sqrt(cosZenith)
    Rgb(
      channel(rows(0), cosZenith, root, cosSun, gamma),
      channel(rows(1), cosZenith, root, cosSun, gamma),
      channel(rows(2), cosZenith, root, cosSun, gamma)
    )

  /** The paper's equations 8 and 9. */
  private def channel(
      c: Array[Double],
      cosZenith: Float,
      root: Double,
      cosSun: Float,
      gamma: Double
  ): Float =
    val cos2 = cosSun.toDouble * cosSun
    val base = 1 + c(8) * c(8) - 2 * c(8) * cosSun
    val aureole = (1 + cos2) / (base * Math.sqrt(base))
    val horizon = 1 + c(0) * Math.exp(c(1) / (cosZenith + 0.01))
    val glow = c(2) + c(3) * Math.exp(c(4) * gamma) + c(5) * cos2 + c(6) * aureole + c(7) * root
    (horizon * glow * c(9)).toFloat

object SkyModel:
  private val Points = 6
  private val Terms = 10
  private val Levels = 10
  private val Elevations = 30
  private val FirstElevation = 2.0 // degrees
  private val ElevationStep = 3.0
  private val Binomials = Array(1.0, 5.0, 10.0, 10.0, 5.0, 1.0)

  private lazy val sky = table("sky")
  private lazy val sun = table("sun")

  /** Linear interpolation in a table of `count` entries. */
  private def interpolated(x: Float, count: Int)(at: Int => Double): Double =
    val clamped = Math.max(0f, Math.min(x, count - 1f))
    val i = Math.min(clamped.toInt, count - 2)
    val t = clamped - i
    at(i) * (1 - t) + at(i + 1) * t

  /** Rows of numbers, some with a | between them; # begins a comment. */
  private def table(name: String): Array[Array[Double]] =
    val stream = getClass.getResourceAsStream(s"/candela/sky/$name.txt")
    val source = Source.fromInputStream(stream)(using Codec.UTF8)
    try
      source
        .getLines()
        .filterNot(_.startsWith("#"))
        .map(_.split("[ |]+").map(_.toDouble))
        .toArray
    finally source.close()

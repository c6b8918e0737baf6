package candela.media

import candela.color.Rgb
import candela.math.*

/** Spatially varying emission of a medium, as the radiance it has where it is opaque and purely
  * absorbing.
  */
abstract class Glow:
  /** Sets the three `glow…` of `out`. */
  def fill(x: Float, y: Float, z: Float, out: MediumPoint): Unit

  def describe: String

/** Constant colour, scaled by a grid. */
final class ColoredGlow(emitted: Rgb, scale: SampledGrid) extends Glow:
  def describe: String = s"emissive (${scale.describe})"

  def fill(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val s = Math.max(0f, scale(x, y, z))
    out.glowR = emitted.r * s
    out.glowG = emitted.g * s
    out.glowB = emitted.b * s

/** Blackbody emission from a grid of temperatures, scaled by another grid.
  *
  * @param offset subtracted from the grid's temperatures, in K
  * @param factor scale of the difference
  * @param colors blackbody colours up to the highest temperature
  */
final class ThermalGlow(
    temperature: SampledGrid,
    offset: Float,
    factor: Float,
    colors: ThermalColors,
    scale: SampledGrid
) extends Glow:
  def describe: String = s"emissive by temperature (${temperature.describe})"

  def fill(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val s = scale(x, y, z)
    val kelvin = (temperature(x, y, z) - offset) * factor
    if s > 0f then colors.fill(kelvin, s, out)
    else
      out.glowR = 0f
      out.glowG = 0f
      out.glowB = 0f

/** A table of blackbody colours by temperature, linearly interpolated. Black up to
  * [[ThermalColors.Coldest]].
  */
final class ThermalColors(hottest: Float, color: Float => Rgb):
  import ThermalColors.*
  private val step = Math.max(1f, (hottest - Coldest) / (Size - 1))
  private val table: Array[Float] =
    Array.tabulate(Size + 1)(i => color(Coldest + i * step)).flatMap(c => Array(c.r, c.g, c.b))

  private[media] def fill(kelvin: Float, scale: Float, out: MediumPoint): Unit =
    if kelvin > Coldest then
      val position = Math.min((kelvin - Coldest) / step, Size - 1f)
      val i = position.toInt
      val w = position - i
      out.glowR = scale * lerp(w, table(3 * i), table(3 * i + 3))
      out.glowG = scale * lerp(w, table(3 * i + 1), table(3 * i + 4))
      out.glowB = scale * lerp(w, table(3 * i + 2), table(3 * i + 5))
    else
      out.glowR = 0f
      out.glowG = 0f
      out.glowB = 0f

object ThermalColors:
  /** In K; as in pbrt-v4. */
  inline val Coldest = 100f
  private inline val Size = 1024

package candela.media

import candela.color.Rgb
import candela.math.Transform
import candela.sampling.PhaseFunction

/** Densities of a sparse grid with their majorants, which serve any colour basis.
  *
  * @param nx, ny, nz size of the voxels' box
  */
final class SparseDensity(val grid: SparseGrid, val nx: Int, val ny: Int, val nz: Int):
  private[media] val bounds = grid.bounds(nx, ny, nz)
  def describe: String = s"$nx×$ny×$nz voxels with bounds of ${bounds.describe}"

/** Blackbody emission from a sparse grid of temperatures.
  *
  * @param offset subtracted from the grid's temperatures, in K
  * @param factor scale of the difference
  * @param scale  scale of the emission
  */
final class SparseGlow(
    temperature: SparseGrid,
    offset: Float,
    factor: Float,
    colors: ThermalColors,
    scale: Float
):
  private[media] def fill(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    colors.fill((temperature(x, y, z) - offset) * factor, scale, out)

/** A medium with a sparse grid of densities, which scale its coefficients.
  *
  * @param absorption, scattering coefficients at a density of 1, per scene unit
  */
final class SparseMedium(
    toUnit: Transform,
    density: SparseDensity,
    absorption: Rgb,
    scattering: Rgb,
    glow: Option[SparseGlow],
    val phase: PhaseFunction
) extends VaryingMedium(toUnit, density.bounds, absorption + scattering):
  private val densities = density.grid
  private val glowing: SparseGlow | Null = glow.orNull
  def isEmissive: Boolean = glow.isDefined
  def isChromatic: Boolean = Medium.isChromatic(absorption, scattering)

  def describe: String =
    s"sparse grid of ${density.describe}" + (if isEmissive then ", emissive by temperature" else "")

  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    out.setDensity(Math.max(0f, densities(x, y, z)), absorption, scattering)
    val light = glowing
    if light != null then
      light.fill(x, y, z, out)
      out.absorbGlow()

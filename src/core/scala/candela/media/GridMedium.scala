package candela.media

import candela.color.Rgb
import candela.math.Transform
import candela.sampling.PhaseFunction

/** A medium with a grid of densities, which scale its coefficients.
  *
  * @param absorption, scattering coefficients at a density of 1, per scene unit
  */
final class GridMedium(
    toUnit: Transform,
    density: SampledGrid,
    absorption: Rgb,
    scattering: Rgb,
    glow: Option[Glow],
    val phase: PhaseFunction
) extends VaryingMedium(toUnit, density.majorants, absorption + scattering):
  private val glowing: Glow | Null = glow.orNull
  def isEmissive: Boolean = glow.isDefined
  def isChromatic: Boolean = Medium.isChromatic(absorption, scattering)

  def describe: String =
    val light = glow.fold("")(g => s", ${g.describe}")
    s"grid ${density.describe} with bounds of ${density.majorants.describe}$light"

  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val d = Math.max(0f, density(x, y, z))
    out.setDensity(d, absorption, scattering)
    val light = glowing
    if light != null then
      light.fill(x, y, z, out)
      out.absorbGlow()

/** Three grids, one per colour. */
final class ColorGrid(val r: SampledGrid, val g: SampledGrid, val b: SampledGrid):
  private[media] def majorant(
      x0: Float,
      y0: Float,
      z0: Float,
      x1: Float,
      y1: Float,
      z1: Float
  ): Float =
    val mr = r.majorant(x0, y0, z0, x1, y1, z1)
    val mg = g.majorant(x0, y0, z0, x1, y1, z1)
    Math.max(Math.max(mr, mg), b.majorant(x0, y0, z0, x1, y1, z1))

/** The scattered part of the extinction, interpolated by itself.
  *
  * @param fromMedium leads from the medium's unit cube to that of the grid
  */
final class AlbedoGrid(albedo: ColorGrid, fromMedium: Transform):
  private val m = fromMedium.m.map(_.toFloat)

  /** Parts the extinction at a point of the medium's unit cube anew. */
  private[media] def part(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val u = m(0) * x + m(1) * y + m(2) * z + m(3)
    val v = m(4) * x + m(5) * y + m(6) * z + m(7)
    val w = m(8) * x + m(9) * y + m(10) * z + m(11)
    val r = out.absorbR + out.scatterR
    val g = out.absorbG + out.scatterG
    val b = out.absorbB + out.scatterB
    out.scatterR = r * albedo.r(u, v, w)
    out.scatterG = g * albedo.g(u, v, w)
    out.scatterB = b * albedo.b(u, v, w)
    out.absorbR = r - out.scatterR
    out.absorbG = g - out.scatterG
    out.absorbB = b - out.scatterB

/** A medium with grids of coefficients; a coefficient without a grid is constant in the box.
  *
  * @param constant absorption or scattering without a grid
  * @param factor   scale of all coefficients
  * @param albedo   parts their sums, if it is given
  */
final class ColorGridMedium(
    toUnit: Transform,
    size: SampledGrid,
    absorption: Option[ColorGrid],
    scattering: Option[ColorGrid],
    constant: Float,
    factor: Float,
    glow: Option[ColorGrid],
    val phase: PhaseFunction,
    albedo: Option[AlbedoGrid] = None
) extends VaryingMedium(
      toUnit,
      ColorGridMedium.bounds(size, absorption, scattering, constant, factor),
      Rgb.White
    ):
  private val absorbing: ColorGrid | Null = absorption.orNull
  private val scatters: ColorGrid | Null = scattering.orNull
  private val glowing: ColorGrid | Null = glow.orNull
  private val shares: AlbedoGrid | Null = albedo.orNull
  private val plain = constant * factor
  def isEmissive: Boolean = glow.isDefined
  def isChromatic: Boolean = true

  def describe: String =
    s"grid ${size.describe} of colours" + (if glow.isDefined then ", emissive" else "")

  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val a = absorbing
    out.absorbR = if a == null then plain else factor * a.r(x, y, z)
    out.absorbG = if a == null then plain else factor * a.g(x, y, z)
    out.absorbB = if a == null then plain else factor * a.b(x, y, z)
    val s = scatters
    out.scatterR = if s == null then plain else factor * s.r(x, y, z)
    out.scatterG = if s == null then plain else factor * s.g(x, y, z)
    out.scatterB = if s == null then plain else factor * s.b(x, y, z)
    val split = shares
    if split != null then split.part(x, y, z, out)
    val light = glowing
    if light != null then
      out.glowR = light.r(x, y, z)
      out.glowG = light.g(x, y, z)
      out.glowB = light.b(x, y, z)
      out.absorbGlow()

object ColorGridMedium:
  private def bounds(
      size: SampledGrid,
      absorption: Option[ColorGrid],
      scattering: Option[ColorGrid],
      constant: Float,
      factor: Float
  ): MajorantGrid =
    MajorantGrid.of(size.nx, size.ny, size.nz): (x0, y0, z0, x1, y1, z1) =>
      def majorant(grid: Option[ColorGrid]) =
        grid.fold(constant)(_.majorant(x0, y0, z0, x1, y1, z1))
      factor * (majorant(absorption) + majorant(scattering))

package candela.media

import candela.math.*
import candela.sampling.PhaseFunction

/** The medium of a turned grid, which fills the box along the world's axes around the grid: beyond
  * the grid, its outermost values continue.
  *
  * @param grid   the medium within the grid
  * @param toUnit world space to the unit cube of this box
  * @param toGrid this unit cube to that of the grid
  */
final class WorldBoxMedium private (grid: VaryingMedium, toUnit: Transform, toGrid: Transform)
    extends VaryingMedium(toUnit, WorldBoxMedium.bounds(grid.bounds, toGrid), grid.extinction):
  val phase: PhaseFunction = grid.phase
  def isEmissive: Boolean = grid.isEmissive
  def isChromatic: Boolean = grid.isChromatic
  def describe: String = s"${grid.describe}, to the box around it"

  protected[media] def coefficients(x: Float, y: Float, z: Float, out: MediumPoint): Unit =
    val p = toGrid.point(Vec3(x, y, z))
    grid.coefficients(p.x, p.y, p.z, out)

object WorldBoxMedium:
  /** @param gridToUnit world space to the unit cube of the grid */
  def apply(grid: VaryingMedium, gridToUnit: Transform): VaryingMedium =
    val toWorld = gridToUnit.inverse
    val corners =
      for x <- Seq(0.0, 1.0); y <- Seq(0.0, 1.0); z <- Seq(0.0, 1.0)
      yield toWorld.position(Position(x, y, z))
    def range(axis: Position => Double) = (corners.map(axis).min, corners.map(axis).max)
    val Seq((x0, x1), (y0, y1), (z0, z1)) = Seq(range(_.x), range(_.y), range(_.z)): @unchecked
    Transform.scale(x1 - x0, y1 - y0, z1 - z0).fold(grid): size =>
      val boxToWorld = Transform.translate(x0, y0, z0) * size
      new WorldBoxMedium(grid, boxToWorld.inverse, gridToUnit * boxToWorld)

  /** Majorants of the box: those of the grid's cells about each of its own. */
  private def bounds(ofGrid: MajorantGrid, toGrid: Transform): MajorantGrid =
    MajorantGrid.of(CellsAcross, CellsAcross, CellsAcross): (x0, y0, z0, x1, y1, z1) =>
      val corners =
        for x <- Seq(x0, x1); y <- Seq(y0, y1); z <- Seq(z0, z1)
        yield toGrid.point(Vec3(x, y, z))
      def cells(axis: Vec3 => Float, count: Int) =
        def cell(at: Float) = clamp(Math.floor(at * count).toInt, 0, count - 1)
        // Lookups are rounded elsewhere than these corners
        cell(corners.map(axis).min - Margin) to cell(corners.map(axis).max + Margin)
      val bounds =
        for
          z <- cells(_.z, ofGrid.nz)
          y <- cells(_.y, ofGrid.ny)
          x <- cells(_.x, ofGrid.nx)
        yield ofGrid(x, y, z)
      bounds.max

  private val CellsAcross = 16
  private val Margin = 1e-4f

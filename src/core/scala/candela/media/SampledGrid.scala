package candela.media

import candela.math.*

/** A [[TrilinearGrid]] that knows how large its values are. */
final class SampledGrid(
    nx: Int,
    ny: Int,
    nz: Int,
    values: Array[Float],
    edge: GridEdge = GridEdge.Zero
) extends TrilinearGrid(nx, ny, nz, values, edge):
  /** Upper bounds of the values. */
  lazy val majorants: MajorantGrid = MajorantGrid.of(nx, ny, nz)(majorant)

  /** Upper bound of the values in a box; at least 0. */
  def majorant(x0: Float, y0: Float, z0: Float, x1: Float, y1: Float, z1: Float): Float =
    def first(p: Float, n: Int) = clamp(Math.floor(p * n - 0.5).toInt, 0, n - 1)
    def last(p: Float, n: Int) = clamp(Math.floor(p * n - 0.5).toInt + 1, 0, n - 1)
    var greatest = 0f
    for
      z <- first(z0, nz) to last(z1, nz)
      y <- first(y0, ny) to last(y1, ny)
      x <- first(x0, nx) to last(x1, nx)
    do greatest = Math.max(greatest, sample(x, y, z))
    greatest

object SampledGrid:
  /** A larger value is no density, but damage: a path through it would have no end. */
  val MaxValue = 1e9f

  /** A single sample at the centre of the cube. Surrounded by zeros, it is 1 there alone and half
    * of it at the centre of each face.
    */
  val One: SampledGrid = SampledGrid(1, 1, 1, Array(1f))

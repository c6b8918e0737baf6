package candela.media

import candela.math.*

/** Values of a grid outside its outermost samples. */
enum GridEdge:
  /** Zero, as in pbrt-v3 and v4. */
  case Zero

  /** Clamped to the outermost samples, as in pbrt-v2 and Mitsuba. */
  case Clamped

/** Values over the unit cube, trilinearly interpolated between cell centres.
  *
  * @param values nx·ny·nz values, x fastest
  */
final class SampledGrid(
    val nx: Int,
    val ny: Int,
    val nz: Int,
    values: Array[Float],
    edge: GridEdge = GridEdge.Zero
):
  private val isClamped = edge == GridEdge.Clamped

  /** Upper bounds of the values. */
  lazy val majorants: MajorantGrid = MajorantGrid.of(nx, ny, nz)(most)

  def apply(x: Float, y: Float, z: Float): Float =
    val sx = x * nx - 0.5f
    val sy = y * ny - 0.5f
    val sz = z * nz - 0.5f
    val ix = Math.floor(sx.toDouble).toInt
    val iy = Math.floor(sy.toDouble).toInt
    val iz = Math.floor(sz.toDouble).toInt
    val wx = sx - ix
    val wy = sy - iy
    lerp(sz - iz, plane(ix, iy, iz, wx, wy), plane(ix, iy, iz + 1, wx, wy))

  private def plane(x: Int, y: Int, z: Int, wx: Float, wy: Float): Float =
    lerp(
      wy,
      lerp(wx, sample(x, y, z), sample(x + 1, y, z)),
      lerp(wx, sample(x, y + 1, z), sample(x + 1, y + 1, z))
    )

  private def sample(x: Int, y: Int, z: Int): Float =
    if isClamped then
      values((clamp(z, 0, nz - 1) * ny + clamp(y, 0, ny - 1)) * nx + clamp(x, 0, nx - 1))
    else if x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz then 0f
    else values((z * ny + y) * nx + x)

  /** Upper bound of the values in a box; at least 0. */
  def most(x0: Float, y0: Float, z0: Float, x1: Float, y1: Float, z1: Float): Float =
    def first(p: Float, n: Int) = clamp(Math.floor(p * n - 0.5).toInt, 0, n - 1)
    def last(p: Float, n: Int) = clamp(Math.floor(p * n - 0.5).toInt + 1, 0, n - 1)
    var greatest = 0f
    for
      z <- first(z0, nz) to last(z1, nz)
      y <- first(y0, ny) to last(y1, ny)
      x <- first(x0, nx) to last(x1, nx)
    do greatest = Math.max(greatest, sample(x, y, z))
    greatest

  def maximum: Float = values.foldLeft(0f)(Math.max)
  def describe: String = s"$nx×$ny×$nz"

object SampledGrid:
  /** A single sample at the centre of the cube. Surrounded by zeros, it is 1 there alone and half
    * of it at the centre of each face.
    */
  val One: SampledGrid = SampledGrid(1, 1, 1, Array(1f))

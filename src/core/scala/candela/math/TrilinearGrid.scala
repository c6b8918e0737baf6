package candela.math

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
class TrilinearGrid(
    val nx: Int,
    val ny: Int,
    val nz: Int,
    values: Array[Float],
    edge: GridEdge = GridEdge.Zero
):
  private val isClamped = edge == GridEdge.Clamped

  final def apply(x: Float, y: Float, z: Float): Float =
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

  protected final def sample(x: Int, y: Int, z: Int): Float =
    if isClamped then
      values((clamp(z, 0, nz - 1) * ny + clamp(y, 0, ny - 1)) * nx + clamp(x, 0, nx - 1))
    else if x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz then 0f
    else values((z * ny + y) * nx + x)

  final def maximum: Float = values.foldLeft(0f)(Math.max)
  final def describe: String = s"$nx×$ny×$nz"

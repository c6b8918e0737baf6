package candela.media

import candela.base.loop
import candela.math.*

/** Majorants of a medium's density, one per cell of the unit cube. Low majorants allow long steps.
  */
final class MajorantGrid(val nx: Int, val ny: Int, val nz: Int, values: Array[Float]):
  def apply(x: Int, y: Int, z: Int): Float = values((z * ny + y) * nx + x)
  def describe: String = s"$nx×$ny×$nz"

object MajorantGrid:
  /** Maximum number of cells along an axis, as in pbrt-v4. */
  private val Finest = 16

  /** A constant majorant. */
  def constant(majorant: Float): MajorantGrid = MajorantGrid(1, 1, 1, Array(majorant))

  /** Majorants at a resolution suited to this number of samples along each axis.
    *
    * @param finest   maximum number of cells along an axis
    * @param majorant upper bound in a box of the unit cube: x0, y0, z0, x1, y1, z1
    */
  def of(nx: Int, ny: Int, nz: Int, finest: Int = Finest)(
      majorant: (Float, Float, Float, Float, Float, Float) => Float
  ): MajorantGrid =
    val cx = Math.min(nx, finest)
    val cy = Math.min(ny, finest)
    val cz = Math.min(nz, finest)
    val values = new Array[Float](cx * cy * cz)
    loop(values.length): i =>
      val x = i % cx
      val y = i / cx % cy
      val z = i / (cx * cy)
      values(i) = majorant(
        x.toFloat / cx,
        y.toFloat / cy,
        z.toFloat / cz,
        (x + 1f) / cx,
        (y + 1f) / cy,
        (z + 1f) / cz
      )
    MajorantGrid(cx, cy, cz, values)

/** Traversal of a [[MajorantGrid]] by a ray, cell by cell. Mutable, one per worker.
  *
  * Source: Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics
  * 1987.
  */
final class MajorantWalk:
  /** The current cell: the ray's entry and exit distances, and the majorant. */
  var start, end, majorant = 0f

  /** The ray in the space of the unit cube. */
  var ox, oy, oz, dx, dy, dz = 0f

  private var grid = MajorantGrid.constant(0f)
  private var last = 0f
  private var ix, iy, iz = 0
  private var nextX, nextY, nextZ = 0f
  private var deltaX, deltaY, deltaZ = 0f

  /** Moves to the cell where the ray enters the unit cube; false if it does not enter before
    * `tMax`.
    */
  def enter(origin: Vec3, direction: Vec3, tMax: Float, bounds: MajorantGrid): Boolean =
    grid = bounds
    ox = origin.x
    oy = origin.y
    oz = origin.z
    dx = direction.x
    dy = direction.y
    dz = direction.z
    end = Math.max(0f, Math.max(near(ox, dx), Math.max(near(oy, dy), near(oz, dz))))
    last = Math.min(tMax, Math.min(far(ox, dx), Math.min(far(oy, dy), far(oz, dz))))
    if !(end < last) then false
    else
      ix = cell(ox + end * dx, grid.nx)
      iy = cell(oy + end * dy, grid.ny)
      iz = cell(oz + end * dz, grid.nz)
      nextX = crossing(ix, ox, dx, grid.nx)
      nextY = crossing(iy, oy, dy, grid.ny)
      nextZ = crossing(iz, oz, dz, grid.nz)
      deltaX = 1f / (grid.nx * Math.abs(dx))
      deltaY = 1f / (grid.ny * Math.abs(dy))
      deltaZ = 1f / (grid.nz * Math.abs(dz))
      true

  /** Moves to the next cell; false at the end of the traversal. */
  def next(): Boolean =
    if !(end < last) then false
    else
      start = end
      majorant = grid(ix, iy, iz)
      if nextX <= nextY && nextX <= nextZ then
        leaveAt(nextX)
        nextX += deltaX
        ix += (if dx < 0f then -1 else 1)
        if ix < 0 || ix == grid.nx then last = end
      else if nextY <= nextZ then
        leaveAt(nextY)
        nextY += deltaY
        iy += (if dy < 0f then -1 else 1)
        if iy < 0 || iy == grid.ny then last = end
      else
        leaveAt(nextZ)
        nextZ += deltaZ
        iz += (if dz < 0f then -1 else 1)
        if iz < 0 || iz == grid.nz then last = end
      true

  private def leaveAt(t: Float): Unit = end = Math.max(start, Math.min(last, t))

  private def near(o: Float, d: Float): Float =
    if d > 0f then -o / d
    else if d < 0f then (1f - o) / d
    else if o >= 0f && o <= 1f then Float.NegativeInfinity
    else Float.PositiveInfinity

  private def far(o: Float, d: Float): Float =
    if d > 0f then (1f - o) / d else if d < 0f then -o / d else Float.PositiveInfinity

  private def cell(p: Float, n: Int): Int = clamp((p * n).toInt, 0, n - 1)

  private def crossing(i: Int, o: Float, d: Float, n: Int): Float =
    if d == 0f then Float.PositiveInfinity else ((if d > 0f then i + 1 else i).toFloat / n - o) / d

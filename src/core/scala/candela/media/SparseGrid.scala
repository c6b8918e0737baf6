package candela.media

import candela.math.*

/** A [[VoxelTree]] over the unit cube.
  *
  * @param toIndex affine map of the unit cube to the voxels' indices
  */
final class SparseGrid(tree: VoxelTree, toIndex: Transform):
  private val m: Array[Float] = Array.tabulate(12)(i => toIndex.m(i).toFloat)

  def apply(x: Float, y: Float, z: Float): Float =
    tree.interpolated(
      m(0) * x + m(1) * y + m(2) * z + m(3),
      m(4) * x + m(5) * y + m(6) * z + m(7),
      m(8) * x + m(9) * y + m(10) * z + m(11)
    )

  def maximum: Float = tree.maximum

  /** Majorants in this many cells along each axis. */
  private[media] def bounds(nx: Int, ny: Int, nz: Int): MajorantGrid =
    MajorantGrid.of(nx, ny, nz, SparseGrid.Finest): (x0, y0, z0, x1, y1, z1) =>
      val corners =
        for x <- Vector(x0, x1); y <- Vector(y0, y1); z <- Vector(z0, z1)
        yield toIndex.point(Vec3(x, y, z))
      // One voxel more on each side, for interpolation and the rounding of `apply`
      def first(axis: Vec3 => Float) = Math.floor(corners.map(axis).min - 0.01).toInt
      def last(axis: Vec3 => Float) = Math.floor(corners.map(axis).max + 0.01).toInt + 1
      tree.majorant(first(_.x), first(_.y), first(_.z), last(_.x), last(_.y), last(_.z))

object SparseGrid:
  /** Maximum number of majorants along an axis, as in pbrt-v4. */
  private val Finest = 64

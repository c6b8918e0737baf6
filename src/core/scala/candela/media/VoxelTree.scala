package candela.media

import candela.base.loop
import candela.math.*

/** Values of voxels, most of which are the background: a grid of nodes of 16³ leaves of 8³ voxels.
  *
  * @param x0, y0, z0 the first voxel, in multiples of a node's size
  * @param nx, ny, nz number of nodes
  * @param nodes      x slowest, as are the leaves of a node and the voxels of a leaf
  */
final class VoxelTree private (
    x0: Int,
    y0: Int,
    z0: Int,
    nx: Int,
    ny: Int,
    nz: Int,
    nodes: Array[VoxelNode],
    background: Float
):
  /** Value between voxels, trilinearly interpolated; voxels are at whole numbers. */
  def interpolated(x: Float, y: Float, z: Float): Float =
    val fx = Math.floor(x.toDouble)
    val fy = Math.floor(y.toDouble)
    val fz = Math.floor(z.toDouble)
    val wx = (x - fx).toFloat
    val wy = (y - fy).toFloat
    val wz = (z - fz).toFloat
    val i = fx.toInt - x0
    val j = fy.toInt - y0
    val k = fz.toInt - z0
    if (i & 7) < 7 && (j & 7) < 7 && (k & 7) < 7 then
      val leaf = leafAt(i, j, k)
      val voxel = VoxelTree.inLeaf(i, j, k)
      lerp(
        wx,
        lerp(
          wy,
          lerp(wz, leaf(voxel), leaf(voxel + 1)),
          lerp(wz, leaf(voxel + 8), leaf(voxel + 9))
        ),
        lerp(
          wy,
          lerp(wz, leaf(voxel + 64), leaf(voxel + 65)),
          lerp(wz, leaf(voxel + 72), leaf(voxel + 73))
        )
      )
    else lerp(wx, plane(i, j, k, wy, wz), plane(i + 1, j, k, wy, wz))

  private def plane(i: Int, j: Int, k: Int, wy: Float, wz: Float): Float =
    lerp(
      wy,
      lerp(wz, value(i, j, k), value(i, j, k + 1)),
      lerp(wz, value(i, j + 1, k), value(i, j + 1, k + 1))
    )

  private def value(i: Int, j: Int, k: Int): Float = leafAt(i, j, k)(VoxelTree.inLeaf(i, j, k))

  /** The leaf of a voxel, counted from the first. */
  private def leafAt(i: Int, j: Int, k: Int): Array[Float] =
    nodeAt(i >> 7, j >> 7, k >> 7).leaves(VoxelTree.inNode(i, j, k))

  private def nodeAt(a: Int, b: Int, c: Int): VoxelNode =
    if a < 0 || b < 0 || c < 0 || a >= nx || b >= ny || c >= nz then outside
    else nodes((a * ny + b) * nz + c)

  private val outside = VoxelNode.constant(background)

  /** Upper bound of the values of these voxels, inclusive; at least 0. */
  def majorant(fromX: Int, fromY: Int, fromZ: Int, toX: Int, toY: Int, toZ: Int): Float =
    // Relative to the first voxel, and cut to one leaf more on each side than there are
    def first(at: Int, start: Int) = Math.max(-8L, at.toLong - start).toInt
    def last(at: Int, start: Int, n: Int) = Math.min((n << 7) + 7L, at.toLong - start).toInt
    val (i0, j0, k0) = (first(fromX, x0), first(fromY, y0), first(fromZ, z0))
    val (i1, j1, k1) = (last(toX, x0, nx), last(toY, y0, ny), last(toZ, z0, nz))
    var greatest = 0f
    for
      i <- (i0 >> 3) to (i1 >> 3)
      j <- (j0 >> 3) to (j1 >> 3)
      k <- (k0 >> 3) to (k1 >> 3)
    do
      val node = nodeAt(i >> 4, j >> 4, k >> 4)
      val n = VoxelTree.inNode(i << 3, j << 3, k << 3)
      if node.mosts(n) > greatest then
        val leaf = node.leaves(n)
        for
          x <- Math.max(i0, i << 3) to Math.min(i1, (i << 3) + 7)
          y <- Math.max(j0, j << 3) to Math.min(j1, (j << 3) + 7)
          z <- Math.max(k0, k << 3) to Math.min(k1, (k << 3) + 7)
        do greatest = Math.max(greatest, leaf(VoxelTree.inLeaf(x, y, z)))
    greatest

  /** The greatest value; at least 0. */
  def maximum: Float =
    nodes.foldLeft(Math.max(0f, background))((largest, node) =>
      node.mosts.foldLeft(largest)(Math.max)
    )

/** 16³ leaves of 8³ values. */
final class VoxelNode(val leaves: Array[Array[Float]]):
  /** The greatest value of each leaf; of leaves that are the same object, found once. */
  private[media] val mosts: Array[Float] =
    val maxima = new Array[Float](leaves.length)
    loop(leaves.length): i =>
      val isAsBefore = i > 0 && (leaves(i) eq leaves(i - 1))
      maxima(i) = if isAsBefore then maxima(i - 1) else VoxelNode.greatest(leaves(i))
    maxima

object VoxelNode:
  val LeafCount = 4096
  val LeafSize = 512

  private def greatest(leaf: Array[Float]): Float =
    var largest = leaf(0)
    loop(leaf.length)(i => largest = Math.max(largest, leaf(i)))
    largest

  def constant(value: Float): VoxelNode =
    val leaf = Array.fill(LeafSize)(value)
    VoxelNode(Array.fill(LeafCount)(leaf))

object VoxelTree:
  /** Voxels of a node along an axis. */
  val NodeWidth = 128

  /** Limits the memory for the space between far nodes. */
  private val MaxNodes = 1 << 22

  /** The tree of these nodes, at most one per place; None if they are too far apart. Places count
    * nodes, not voxels.
    */
  def of(entries: Iterable[(Int, Int, Int, VoxelNode)], background: Float): Option[VoxelTree] =
    def range(axis: ((Int, Int, Int, VoxelNode)) => Int) =
      if entries.isEmpty then (0, 1L)
      else
        val coordinates = entries.map(axis)
        (coordinates.min, coordinates.max.toLong - coordinates.min + 1)
    val ((x, nx), (y, ny), (z, nz)) = (range(_(0)), range(_(1)), range(_(2)))
    val fits =
      nx <= MaxNodes && ny <= MaxNodes && nx * ny <= MaxNodes && nx * ny * nz <= MaxNodes
    Option.when(fits):
      val empty = VoxelNode.constant(background)
      val nodes = Array.fill((nx * ny * nz).toInt)(empty)
      for (a, b, c, node) <- entries do
        nodes(((a - x) * ny.toInt + (b - y)) * nz.toInt + (c - z)) = node
      VoxelTree(
        x * NodeWidth,
        y * NodeWidth,
        z * NodeWidth,
        nx.toInt,
        ny.toInt,
        nz.toInt,
        nodes,
        background
      )

  private def inLeaf(i: Int, j: Int, k: Int): Int = (i & 7) << 6 | (j & 7) << 3 | (k & 7)
  private def inNode(i: Int, j: Int, k: Int): Int =
    (i & 0x78) << 5 | (j & 0x78) << 1 | (k & 0x78) >> 3

package candela.build.media

import candela.base.loop
import java.nio.ByteBuffer

import scala.collection.mutable

import candela.math.Transform
import candela.media.{SampledGrid, VoxelNode, VoxelTree}

/** Reads the grid of a [[NanoVdbFile]]: its map and its tree of root, upper nodes (32³ lower ones),
  * lower nodes (16³ leaves) and leaves (8³ voxels).
  */
private[media] object NanoVdbTree:

  def read(bytes: GridBytes): NanoVdbGrid = Reader(bytes).grid()

  // Places in the header
  private val HeaderSize = 672
  private val InverseMatrix = 456
  private val Translation = 528
  private val GridClass = 632
  private val GridType = 636
  private val RootOffset = HeaderSize + 24

  private val Classes = Vector("unknown", "level set", "fog volume", "staggered", "point index",
    "point data", "topology", "voxel volume")
  private val Types =
    Vector("unknown", "float", "double", "int16", "int32", "int64", "vec3f", "vec3d",
      "mask", "half", "uint32", "bool", "rgba8", "fp4", "fp8", "fp16", "fpN", "vec4f", "vec4d")

  private val RootSize = 64
  private val TileSize = 32

  /** A node with a table of values or children.
    *
    * @param log bits of the table's size along an axis
    */
  private enum Level(log: Int):
    case Upper extends Level(5)
    case Lower extends Level(4)
    val slots: Int = 1 << 3 * log
    val children: Int = 32 + slots / 8
    val table: Int = (children + slots / 8 + 16 + 31) / 32 * 32
    val size: Int = table + 8 * slots

  /** Limits the memory for nodes that hold one value; they are rare. */
  private val MaxConstants = 1000

  private val LeafValues = 96
  private val LeafSize = LeafValues + 4 * VoxelNode.LeafSize

  private final class Reader(bytes: GridBytes):
    private val nodes = mutable.ArrayBuffer.empty[(Int, Int, Int, VoxelNode)]
    private val constants = mutable.HashMap.empty[Int, Array[Float]]
    private val constantNodes = mutable.HashMap.empty[Int, VoxelNode]

    // More nodes than bytes for them: some are used twice
    private var nodesLeft = bytes.size / Level.Lower.size + bytes.size / Level.Upper.size
    private var leavesLeft = bytes.size / LeafSize

    def grid(): NanoVdbGrid =
      val header = bytes.read(0, HeaderSize + 64)
      val (kind, use) = (header.getInt(GridType), header.getInt(GridClass))
      if kind != 1 then
        throw NanoVdbError(s"its values are of type ${named(kind, Types)}, expected float")
      if use != 0 && use != 2 then
        throw NanoVdbError(s"the grid is a ${named(use, Classes)}, expected a fog volume")
      NanoVdbChecksum.check(bytes, Level.Upper.size, Level.Lower.size, LeafSize)
      val root = HeaderSize + header.getLong(RootOffset)
      val head = bytes.read(root, RootSize)
      val tiles = head.getInt(24)
      val background = number(head.getFloat(28))
      if tiles < 0 || tiles > (bytes.size - root) / TileSize then
        throw NanoVdbError(s"the root can't have ${tiles & 0xffffffffL} tiles")
      loop(tiles)(i =>
        tile(bytes.read(root + RootSize + i * TileSize.toLong, TileSize), root, background)
      )
      val tree = VoxelTree.of(nodes, background)
        .getOrElse(throw NanoVdbError("its voxels are too far apart"))
      val (low, high) = (coordinates(head, 0), coordinates(head, 12))
      if low.zip(high).exists((a, b) => a > b || b.toLong - a >= (1 << 24)) then
        throw NanoVdbError(s"the box of its voxels is empty or too large: $low to $high")
      NanoVdbGrid(tree, map(header), low, high)

    private def named(number: Int, names: Vector[String]) =
      names.lift(number).getOrElse(s"number $number")

    private def coordinates(node: ByteBuffer, at: Int) =
      Vector.tabulate(3)(i => node.getInt(at + 4 * i))

    /** Translated, rotated and scaled voxels; a shear would spoil the bounds of densities. */
    private def map(header: ByteBuffer): Transform =
      val m = Array.tabulate(9)(i => header.getDouble(InverseMatrix + 8 * i))
      val t = Array.tabulate(3)(i => header.getDouble(Translation + 8 * i))
      def row(i: Int) = m.slice(3 * i, 3 * i + 3)
      def dot(a: Array[Double], b: Array[Double]) = a.lazyZip(b).map(_ * _).sum
      val isSheared = Seq((0, 1), (0, 2), (1, 2)).exists: (i, j) =>
        val (a, b) = (row(i), row(j))
        !(Math.abs(dot(a, b)) <= 1e-4 * Math.sqrt(dot(a, a) * dot(b, b)))
      val rows = (0 until 3).flatMap(i => row(i) :+ -dot(row(i), t)) ++ Vector(0.0, 0.0, 0.0, 1.0)
      Transform.fromRows(rows).filterNot(_ => isSheared).getOrElse(
        throw NanoVdbError("the map of its voxels must be a rotation and a scale")
      )

    /** A tile of the root: an upper node, or the value of as many voxels. */
    private def tile(tile: ByteBuffer, root: Long, background: Float): Unit =
      val (key, child) = (tile.getLong(0), tile.getLong(8))
      // Three numbers of 21 bits, in units of upper nodes; of voxels modulo 2^32
      val corner =
        Vector(42, 21, 0).map(shift => ((key >>> shift).toInt << 12) / VoxelTree.NodeWidth)
      val value = number(tile.getFloat(20))
      if child != 0 then upper(root + child, corner, background)
      else if value != background then
        val node = constantNode(value)
        loop(Level.Upper.slots)(n => add(corner, n, node))

    private def upper(at: Long, corner: Vector[Int], background: Float): Unit =
      val node = visit(at, Level.Upper)
      loop(Level.Upper.slots): n =>
        val entry = Level.Upper.table + 8 * n
        if isChild(node, Level.Upper, n) then add(corner, n, lower(at + node.getLong(entry)))
        else
          val value = number(node.getFloat(entry))
          if value != background then add(corner, n, constantNode(value))

    private def lower(at: Long): VoxelNode =
      val node = visit(at, Level.Lower)
      VoxelNode(Array.tabulate(VoxelNode.LeafCount): n =>
        val entry = Level.Lower.table + 8 * n
        if isChild(node, Level.Lower, n) then leaf(at + node.getLong(entry))
        else constant(number(node.getFloat(entry))))

    private def leaf(at: Long): Array[Float] =
      leavesLeft -= 1
      if leavesLeft < 0 then throw NanoVdbError("it has more leaves than bytes for them")
      val values = bytes.read(at + LeafValues, 4 * VoxelNode.LeafSize)
      Array.tabulate(VoxelNode.LeafSize)(i => number(values.getFloat(4 * i)))

    private def visit(at: Long, level: Level): ByteBuffer =
      nodesLeft -= 1
      if nodesLeft < 0 then throw NanoVdbError("it has more nodes than bytes for them")
      bytes.read(at, level.size)

    private def isChild(node: ByteBuffer, level: Level, n: Int): Boolean =
      (node.get(level.children + n / 8) >> (n % 8) & 1) != 0

    private def constant(value: Float): Array[Float] =
      constants.getOrElseUpdate(
        java.lang.Float.floatToIntBits(value),
        Array.fill(VoxelNode.LeafSize)(value)
      )

    /** Equal ones are one object: damaged files have many. */
    private def constantNode(value: Float): VoxelNode =
      val node = constantNodes.getOrElseUpdate(
        java.lang.Float.floatToIntBits(value),
        VoxelNode(Array.fill(VoxelNode.LeafCount)(constant(value)))
      )
      if constantNodes.size > MaxConstants then
        throw NanoVdbError(s"more than $MaxConstants of its large tiles differ")
      node

    private def number(value: Float): Float =
      if !(Math.abs(value) <= SampledGrid.MaxValue) then
        throw NanoVdbError(s"its value $value is no density: it is damaged")
      value

    private def add(corner: Vector[Int], n: Int, node: VoxelNode): Unit =
      nodes.append((
        corner(0) + (n >> 10),
        corner(1) + (n >> 5 & 31),
        corner(2) + (n & 31),
        node
      )): Unit

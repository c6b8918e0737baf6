package candela.build.media

import candela.base.loop
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.CRC32

/** The two checksums of a NanoVDB grid, of its head and of its nodes, each of which may be missing.
  *
  * What they cover changed with the versions of the library, which files don't tell reliably: any
  * of the ways counts. Damage has a chance of 1 in 10⁹ to agree with one.
  *
  * Source: NanoVDB's `GridChecksum.h`, openvdb.org: versions 32.3 (sums of nodes), 32.6 (of blocks)
  * and 32.7 (of blocks, which include the root).
  */
private[media] object NanoVdbChecksum:
  private val Missing = -1

  // Places in the grid
  private val Sums = 8
  private val FirstByte = 16
  private val TreeEnd = 736
  private val Blind = 640
  private val Tree = 672
  private val Counts = 704

  private val RootSize = 64
  private val TileSize = 32
  private val BlockSize = 4096
  private val ReadSize = 1 << 20

  /** @param upper, lower, leaf sizes of nodes
    * @throws NanoVdbError if the grid is damaged
    */
  def check(bytes: GridBytes, upper: Int, lower: Int, leaf: Int): Unit =
    val sums = bytes.read(Sums, 8)
    val (head, tail) = (sums.getInt(0), sums.getInt(4))
    // Writers without checksums leave zeros, too
    if (head != Missing || tail != Missing) && (head != 0 || tail != 0) then
      val ends = headEnds(bytes)
      if !ends.exists(end => crc(bytes, FirstByte, end) == head) then refuse("head")
      def byBlocks = ends.exists(blocks(bytes, _) == tail)
      def byNodes = nodes(bytes, Vector(upper, lower, leaf)).contains(tail)
      if tail != Missing && !byBlocks && !byNodes then refuse("nodes")

  private def refuse(what: String) =
    throw NanoVdbError(s"the file is damaged: the checksum of the grid's $what is wrong")

  /** Where the head may end: after the tree, after the root, or before what is no node. */
  private def headEnds(bytes: GridBytes): Vector[Long] =
    val header = bytes.read(0, TreeEnd)
    val root = Tree + header.getLong(Tree + 24)
    val tiles =
      if root >= TreeEnd && root <= bytes.size - RootSize then bytes.read(root, RootSize).getInt(24)
      else 0
    val firstUpper = Tree + header.getLong(Tree + 16)
    Vector(
      TreeEnd.toLong,
      root + RootSize + TileSize * tiles.toLong,
      firstUpper,
      header.getLong(Blind),
      bytes.size
    ).filter(end => end >= TreeEnd && end <= bytes.size).distinct

  private def crc(bytes: GridBytes, from: Long, end: Long): Int =
    val sum = CRC32()
    var position = from
    while position < end do
      val count = Math.min(end - position, ReadSize).toInt
      sum.update(bytes.read(position, count))
      position += count
    sum.getValue.toInt

  /** The sum of the sums of blocks; the last one has the rest. */
  private def blocks(bytes: GridBytes, from: Long): Int =
    val count = (bytes.size - from) / BlockSize
    val combined = CRC32()
    val buffer = ByteBuffer.allocate(4).order(ByteOrder.LITTLE_ENDIAN)
    var i = 0L
    while i < count do
      val start = from + i * BlockSize
      val end = if i == count - 1 then bytes.size else start + BlockSize
      combined.update(buffer.clear().putInt(crc(bytes, start, end)).flip())
      i += 1
    combined.getValue.toInt

  /** The sum of the sums of nodes, each of which has 4 bytes or, on some systems, 8. */
  private def nodes(bytes: GridBytes, sizes: Vector[Int]): Vector[Int] =
    val header = bytes.read(0, TreeEnd)
    // From the upper ones to the leaves
    val levels = Vector(2, 1, 0).zip(sizes).map: (level, size) =>
      val first = Tree + header.getLong(Tree + 8 * level)
      (first, header.getInt(Counts + 4 * level), size)
    val fits = levels.forall: (first, count, size) =>
      count >= 0 && first >= 0 && count.toLong * size <= bytes.size - first
    if !fits then Vector.empty
    else
      val (short, long) = (CRC32(), CRC32())
      val buffer = ByteBuffer.allocate(8).order(ByteOrder.LITTLE_ENDIAN)
      for (first, count, size) <- levels do
        loop(count): i =>
          val start = first + i.toLong * size
          val _ = buffer.clear().putLong(crc(bytes, start, start + size) & 0xffffffffL)
          short.update(buffer.array, 0, 4)
          long.update(buffer.array, 0, 8)
      Vector(short.getValue.toInt, long.getValue.toInt)

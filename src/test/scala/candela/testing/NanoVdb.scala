package candela.testing

import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.Deflater

import scala.util.Random

/** A grid to be written as NanoVDB.
  *
  * @param values  values by x, y and z; all other voxels are 0
  * @param scale   size of a voxel
  * @param shift   place of voxel 0, 0, 0
  * @param turned  whether the grid's x and y run along −y and x of the world
  */
final case class VdbGrid(
    name: String,
    values: Map[(Int, Int, Int), Float],
    scale: Double = 1,
    shift: Vector[Double] = Vector(0, 0, 0),
    turned: Boolean = false
)

/** Writes NanoVDB files of version 32.3, for tests and for `scenes/volumes`. */
object NanoVdb:
  private val Version = 32 << 21 | 3 << 10 | 3
  private val Mark = "NanoVDB0".getBytes(ISO_8859_1)

  /** A file of one segment. */
  def file(grids: Seq[VdbGrid], zipped: Boolean = false): Array[Byte] =
    val bodies = grids.map(g => body(g))
    val stored = bodies.map(b => if zipped then zip(b) else b)
    val out = ByteArrayOutputStream()
    def add(size: Int)(fill: ByteBuffer => Any): Unit =
      val part = buffer(size)
      val _ = fill(part)
      out.writeBytes(part.array)
    add(16)(_.put(Mark).putInt(Version).putShort(grids.size.toShort).putShort(if zipped then 1
    else 0))
    for ((grid, body), bytes) <- grids.zip(bodies).zip(stored) do
      val name = grid.name.getBytes(ISO_8859_1) :+ 0.toByte
      add(176): meta =>
        meta.putLong(body.length).putLong(bytes.length).putLong(hash(grid.name))
        meta.putLong(grid.values.size).putInt(1).putInt(2)
        meta.put(body, 560, 48)
        meta.put(body, 672 + 64, 24)
        meta.put(body, 608, 24)
        meta.putInt(name.length)
        meta.put(body, 672 + 32, 12).putInt(1)
        meta.position(168)
        meta.putShort(if zipped then 1 else 0).putShort(0).putInt(Version)
      out.writeBytes(name)
    stored.foreach(out.writeBytes)
    out.toByteArray

  private def buffer(size: Int) = ByteBuffer.allocate(size).order(ByteOrder.LITTLE_ENDIAN)

  private def hash(name: String): Long =
    name.foldLeft(0L)((h, c) => h * 67 + c + (h >>> 56))

  private def zip(bytes: Array[Byte]): Array[Byte] =
    val deflater = Deflater()
    deflater.setInput(bytes)
    deflater.finish()
    val out = new Array[Byte](bytes.length + 1000)
    val count = deflater.deflate(out)
    buffer(8).putLong(count).array ++ out.take(count)

  /** The grid as in memory: header, tree, root, upper nodes, lower nodes, leaves. */
  private def body(grid: VdbGrid): Array[Byte] =
    def key(v: (Int, Int, Int), log: Int) = (v._1 >> log, v._2 >> log, v._3 >> log)
    val voxels = grid.values.keys.toVector.sorted
    val Vector(uppers, lowers, leaves) =
      Vector(12, 7, 3).map(log => voxels.map(key(_, log)).distinct): @unchecked
    val root = 672 + 64
    val firstUpper = root + 64 + 32 * uppers.size
    val firstLower = firstUpper + 270400 * uppers.size
    val firstLeaf = firstLower + 33856 * lowers.size
    val size = firstLeaf + 2144 * leaves.size
    val out = buffer(size)
    val low = Vector(voxels.map(_._1).min, voxels.map(_._2).min, voxels.map(_._3).min)
    val high = Vector(voxels.map(_._1).max, voxels.map(_._2).max, voxels.map(_._3).max)
    header(out, grid, low, high)
    for (offset, i) <- Vector(firstLeaf, firstLower, firstUpper, root).zipWithIndex do
      out.putLong(672 + 8 * i, offset - 672)
    out.putInt(704, leaves.size).putInt(708, lowers.size).putInt(712, uppers.size)
    out.putLong(728, voxels.size)

    def box(at: Int) = for i <- 0 until 3 do
      out.putInt(at + 4 * i, low(i)).putInt(at + 12 + 4 * i, high(i))
    def stats(at: Int) =
      out.putFloat(at, grid.values.values.min).putFloat(at + 4, grid.values.values.max)
    box(root)
    out.putInt(root + 24, uppers.size)
    stats(root + 32)
    for ((x, y, z), i) <- uppers.zipWithIndex do
      val tile = root + 64 + 32 * i
      def part(v: Int) = (v & 0xfffff).toLong
      out.putLong(tile, part(z) | part(y) << 21 | part(x) << 42)
      out.putLong(tile + 8, firstUpper + 270400 * i - root)
      box(firstUpper + 270400 * i)
      stats(firstUpper + 270400 * i + 8224)
    def link(at: Int, mask: Int, table: Int, slot: Int, child: Int) =
      out.put(at + mask + slot / 8, (out.get(at + mask + slot / 8) | 1 << slot % 8).toByte)
      out.putLong(at + table + 8 * slot, child - at)
    for (v @ (x, y, z), i) <- lowers.zipWithIndex do
      val at = firstLower + 33856 * i
      box(at)
      stats(at + 1056)
      val parent = firstUpper + 270400 * uppers.indexOf(key(v, 5))
      link(parent, 32 + 4096, 8256, (x & 31) << 10 | (y & 31) << 5 | (z & 31), at)
    for (v @ (x, y, z), i) <- leaves.zipWithIndex do
      val at = firstLeaf + 2144 * i
      for (c, j) <- Vector(x, y, z).zipWithIndex do out.putInt(at + 4 * j, c * 8): Unit
      for j <- 12 until 15 do out.put(at + j, 7.toByte): Unit
      stats(at + 80)
      val parent = firstLower + 33856 * lowers.indexOf(key(v, 4))
      link(parent, 32 + 512, 1088, (x & 15) << 8 | (y & 15) << 4 | (z & 15), at)
    for ((x, y, z), value) <- grid.values do
      val at = firstLeaf + 2144 * leaves.indexOf(key((x, y, z), 3))
      val n = (x & 7) << 6 | (y & 7) << 3 | (z & 7)
      out.put(at + 16 + n / 8, (out.get(at + 16 + n / 8) | 1 << n % 8).toByte)
      out.putFloat(at + 96 + 4 * n, value)
    out.array

  private def header(out: ByteBuffer, grid: VdbGrid, low: Vector[Int], high: Vector[Int]): Unit =
    out.put(0, Mark).putLong(8, -1L).putInt(16, Version).putInt(20, 6).putInt(28, 1)
    out.putLong(32, out.capacity).put(40, grid.name.getBytes(ISO_8859_1))
    val turn =
      if grid.turned then Vector(0, -1, 0, 1, 0, 0, 0, 0, 1) else Vector(1, 0, 0, 0, 1, 0, 0, 0, 1)
    val back = Vector.tabulate(9)(i => turn(i % 3 * 3 + i / 3))
    for i <- 0 until 9 do
      val (m, inverse) = (turn(i) * grid.scale, back(i) / grid.scale)
      out.putFloat(296 + 4 * i, m.toFloat).putFloat(332 + 4 * i, inverse.toFloat)
      out.putDouble(384 + 8 * i, m).putDouble(456 + 8 * i, inverse)
    for i <- 0 until 3 do
      out.putFloat(368 + 4 * i, grid.shift(i).toFloat).putDouble(528 + 8 * i, grid.shift(i))
      out.putDouble(608 + 8 * i, grid.scale)
    out.putFloat(380, 1f).putDouble(552, 1)
    def world(p: Vector[Int]) = Vector.tabulate(3): r =>
      (0 until 3).map(c => turn(3 * r + c) * grid.scale * p(c)).sum + grid.shift(r)
    val (a, b) = (world(low), world(high.map(_ + 1)))
    for i <- 0 until 3 do
      out.putDouble(560 + 8 * i, Math.min(a(i), b(i))).putDouble(584 + 8 * i, Math.max(a(i), b(i)))
    out.putInt(632, 2).putInt(636, 1): Unit

  /** A lumpy puff of smoke over a warm spot, in voxels from 0 to 18: the least nodes. */
  def smoke(scale: Double, shift: Vector[Double]): Vector[VdbGrid] =
    val random = Random(5)
    val lumps = Vector.fill(6)(Vector.fill(3)(random.nextDouble() * 12 + 3))
    val density =
      for
        x <- 0 to 18; y <- 0 to 18; z <- 0 to 18
        d = lumps.map(c => distance(c, Vector(x, y, z))).min
        value = Math.max(0.0, 1 - d / 5)
        if value > 0
      yield (x, y, z) -> value.toFloat
    val heat =
      for
        x <- 2 to 16; y <- 2 to 16; z <- 0 to 14
        d = distance(Vector(9, 9, 6), Vector(x, y, z)) if d < 7
      yield (x, y, z) -> (300 + 260 * (7 - d)).toFloat
    Vector(
      VdbGrid("density", density.toMap, scale, shift),
      VdbGrid("temperature", heat.toMap, scale, shift)
    )

  private def distance(a: Seq[Double], b: Seq[Int]): Double =
    Math.sqrt(a.zip(b).map((p, q) => (p - q) * (p - q)).sum)

  /** Writes `scenes/volumes/smoke.nvdb`. */
  def main(args: Array[String]): Unit =
    val grids = smoke(0.06, Vector(-0.54, -0.54, 0.05))
    val _ = Files.write(Path.of(args.head), file(grids, zipped = true))

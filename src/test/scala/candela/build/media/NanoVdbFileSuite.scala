package candela.build.media

import candela.io.InputFile
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import scala.util.Random

import candela.math.*
import candela.testing.{NanoVdb, VdbGrid}

final class NanoVdbFileSuite extends AnyFunSuite:

  private def read(bytes: Array[Byte], name: String = "density") =
    val file = Files.createTempFile("candela", ".nvdb")
    try NanoVdbFile.read(InputFile.named(Files.write(file, bytes)), name)
    finally Files.delete(file)

  private def grid(bytes: Array[Byte], name: String = "density"): NanoVdbGrid =
    read(bytes, name).toOption.get

  private def refusal(bytes: Array[Byte]): String =
    intercept[NanoVdbError](read(bytes)).getMessage

  /** Voxels in several leaves, nodes and tiles of the root, on both sides of zero. */
  private val values: Map[(Int, Int, Int), Float] =
    val random = Random(1)
    val corners = Vector((0, 0, 0), (7, 7, 7), (-130, 126, 4094), (-1, -1, -1), (120, 5, 4100))
    corners.flatMap((x, y, z) =>
      for i <- 0 to 2; j <- 0 to 2; k <- 0 to 2
      yield (x + i, y + j, z + k) -> random.nextFloat()
    ).toMap

  private def at(grid: NanoVdbGrid, p: (Int, Int, Int)) =
    grid.tree.interpolated(p._1.toFloat, p._2.toFloat, p._3.toFloat)

  test("a value that is no density is refused, as it would make paths without an end"):
    for value <- Vector(1e30f, -1e30f, Float.NaN, Float.PositiveInfinity) do
      val bytes = NanoVdb.file(Vector(VdbGrid("density", Map((0, 0, 0) -> value))))
      assert(refusal(bytes) == s"its value $value is no density: it is damaged")

  for zipped <- Vector(false, true) do
    test(s"every voxel is read, and zero everywhere else${if zipped then ", by ZIP" else ""}"):
      val found = grid(NanoVdb.file(Vector(VdbGrid("density", values)), zipped))
      for (p, value) <- values do assert(at(found, p) == value)
      for p <- Vector((3, 3, 3), (-200, 0, 0), (100000, 0, 0), (0, 0, 50), (-1, -1, 4000)) do
        assert(at(found, p) == 0f)
      assert(found.low == Vector(-130, -1, -1) && found.high == Vector(122, 128, 4102))

  test("between voxels, values are interpolated, across leaves and nodes too"):
    val found = grid(NanoVdb.file(Vector(VdbGrid("density", values))))
    def value(x: Int, y: Int, z: Int) = values.getOrElse((x, y, z), 0f)
    for (x, y, z) <- Vector((0, 0, 0), (7, 7, 7), (-130, 127, 4095), (-1, -1, -1), (1, 7, 0)) do
      val (u, v, w) = (0.25f, 0.5f, 0.125f)
      def line(i: Int, j: Int) = lerp(w, value(i, j, z), value(i, j, z + 1))
      def plane(i: Int) = lerp(v, line(i, y), line(i, y + 1))
      val wanted = lerp(u, plane(x), plane(x + 1))
      assert(Math.abs(found.tree.interpolated(x + u, y + v, z + w) - wanted) < 1e-6f, s"$x $y $z")

  test("bounds of boxes are exact"):
    val tree = grid(NanoVdb.file(Vector(VdbGrid("density", values)))).tree
    assert(tree.maximum == values.values.max)
    val random = Random(2)
    for _ <- 0 until 200 do
      val (x, y, z) = values.keys.toVector(random.nextInt(values.size))
      val Vector(a, b, c, d, e, f) = Vector.fill(6)(random.nextInt(12)): @unchecked
      val inside = values.collect:
        case ((i, j, k), v)
            if i >= x - a && i <= x + b && j >= y - c && j <= y + d && k >= z - e && k <= z + f =>
          v
      assert(tree.majorant(x - a, y - c, z - e, x + b, y + d, z + f) == inside.max)
    val all = Int.MinValue
    assert(tree.majorant(all, all, all, Int.MaxValue, Int.MaxValue, Int.MaxValue) == tree.maximum)

  test("the map of a grid is read: scaled, turned and moved"):
    val shift = Vector(1.0, 2.0, 3.0)
    val found =
      grid(NanoVdb.file(Vector(VdbGrid("density", values, 0.5, shift, turned = true))))
    // x to −y: voxel (2, 4, 6) is at (1 + 4/2 · −1 …): the writer's matrix is 0 −1 0 / 1 0 0
    assert(found.toIndex.inverse.point(Vec3(2f, 4f, 6f)) == Vec3(-1f, 3f, 6f))

  test("grids are found by name; others are listed"):
    val other = Map((1, 2, 3) -> 5f)
    val file = NanoVdb.file(Vector(VdbGrid("density", values), VdbGrid("heat", other)))
    assert(at(grid(file, "heat"), (1, 2, 3)) == 5f)
    assert(read(file, "flame") == Left(Vector("density", "heat")))
    val twice = file ++ NanoVdb.file(Vector(VdbGrid("fog", other)))
    assert(at(grid(twice, "fog"), (1, 2, 3)) == 5f)

  test("constant tiles of nodes stand for all of their voxels"):
    val file = NanoVdb.file(Vector(VdbGrid("density", Map((0, 0, 0) -> 1f))))
    val body = 16 + 176 + 8
    val root = body + 672 + 64
    val upper = root + 64 + 32
    val lower = upper + 270400
    def put(at: Int, value: Float) =
      java.nio.ByteBuffer.wrap(file).order(java.nio.ByteOrder.LITTLE_ENDIAN).putFloat(at, value)
    put(upper + 8256 + 8 * 1, 7f)
    put(lower + 1088 + 8 * 1, 3f): Unit
    val found = grid(file)
    assert(at(found, (0, 0, 128)) == 7f && at(found, (127, 127, 255)) == 7f)
    assert(at(found, (0, 0, 8)) == 3f && at(found, (7, 7, 15)) == 3f)
    assert(at(found, (0, 0, 7)) == 0f && at(found, (0, 0, 256)) == 0f)

  test("large tiles of many values are refused, of one value they share memory"):
    val file = NanoVdb.file(Vector(VdbGrid("density", Map((0, 0, 0) -> 1f))))
    val table = 16 + 176 + 8 + 672 + 64 + 64 + 32 + 8256
    def filled(count: Int, value: Int => Float) =
      val copy = file.clone
      val bytes = java.nio.ByteBuffer.wrap(copy).order(java.nio.ByteOrder.LITTLE_ENDIAN)
      for n <- 1 to count do bytes.putFloat(table + 8 * n, value(n))
      copy
    assert(refusal(filled(1001, _.toFloat)) == "more than 1000 of its large tiles differ")
    assert(at(grid(filled(32767, _ => 3f)), (0, 0, 130)) == 3f)

  test("what can't be read is named"):
    val file = NanoVdb.file(Vector(VdbGrid("density", Map((0, 0, 0) -> 1f))))
    def changed(at: Int, bytes: Int*) = file.patch(at, bytes.map(_.toByte), bytes.size)
    val body = 16 + 176 + 8
    assert(refusal("no volume at all".getBytes).startsWith("not a NanoVDB file: byte 0"))
    assert(refusal(Array.emptyByteArray) == "the file is empty")
    assert(refusal(changed(11, 5)) == "it has version 40 of the format, expected 32")
    assert(refusal(changed(14, 2)).startsWith("grid `density` is stored with BLOSC, expected"))
    assert(refusal(changed(body + 636, 15)) == "its values are of type fp16, expected float")
    assert(refusal(changed(body + 632, 1)) == "the grid is a level set, expected a fog volume")
    assert(refusal(file.take(300000)).startsWith("the file is cut short: 307232 bytes at 200"))
    assert(refusal(changed(body + 672 + 64 + 24, 255, 255, 255, 127)).contains("tiles"))
    assert(refusal(changed(body + 456, 0, 0, 0, 0, 0, 0, 0, 0)).contains("a rotation and a scale"))
    val zipped = NanoVdb.file(Vector(VdbGrid("density", Map((0, 0, 0) -> 1f))), zipped = true)
    val longer = zipped.patch(16 + 7, Array[Byte](1), 1)
    assert(refusal(longer).startsWith("a ZIP stream is cut short"))

  /** With the checksums of a version, computed as its library does. */
  private def summed(minor: Int, isFull: Boolean): Array[Byte] =
    val file = NanoVdb.file(Vector(VdbGrid("density", values)))
    val body = java.nio.ByteBuffer.wrap(file, 200, file.length - 200).slice()
      .order(java.nio.ByteOrder.LITTLE_ENDIAN)
    val _ = body.putInt(16, 32 << 21 | minor << 10)
    def crc(from: Int, end: Int): Int =
      val sum = java.util.zip.CRC32()
      sum.update(body.array, 200 + from, end - from)
      sum.getValue.toInt
    def ofAll(sums: Seq[Int], size: Int): Int =
      val bytes = java.nio.ByteBuffer.allocate(sums.size * size)
        .order(java.nio.ByteOrder.LITTLE_ENDIAN)
      for (sum, i) <- sums.zipWithIndex do bytes.putInt(i * size, sum): Unit
      val all = java.util.zip.CRC32()
      all.update(bytes.array)
      all.getValue.toInt
    val tiles = body.getInt(736 + 24)
    val head = if minor >= 7 then 736 else 736 + 64 + 32 * tiles
    val nodes =
      for
        (level, size) <- Seq(2 -> 270400, 1 -> 33856, 0 -> 2144)
        i <- 0 until body.getInt(704 + 4 * level)
      yield
        val at = 672 + body.getLong(672 + 8 * level).toInt + i * size
        crc(at, at + size)
    val blocks = (body.capacity - head) / 4096
    val sums = (0 until blocks).map: i =>
      crc(head + 4096 * i, if i == blocks - 1 then body.capacity else head + 4096 * (i + 1))
    val tail =
      if minor < 5 then ofAll(nodes, 8)
      else if minor == 5 then ofAll(nodes, 4)
      else ofAll(sums, 4)
    body.putInt(8, crc(16, head)).putInt(12, if isFull then tail else -1): Unit
    file

  test("checksums are those of each version, of the head alone or of all"):
    for minor <- Vector(3, 5, 6, 7); isFull <- Vector(false, true) do
      val file = summed(minor, isFull)
      assert(at(grid(file), (0, 0, 0)) == values((0, 0, 0)), s"32.$minor")
      def changed(place: Int) = file.patch(place, Array((file(place) ^ 1).toByte), 1)
      // A part of the world's box, and of a leaf's voxels
      val (head, leaf) = (200 + 570, file.length - 100)
      assert(refusal(changed(head)).endsWith("the checksum of the grid's head is wrong"))
      if isFull then
        assert(refusal(changed(leaf)).endsWith("the checksum of the grid's nodes is wrong"))
      else assert(read(changed(leaf)).isRight)

  test("a grid without checksums, or with zeros in their place, is read"):
    val file = summed(3, isFull = true)
    for none <- Vector(0, -1) do
      val copy = file.patch(208, Array.fill(8)(none.toByte), 8)
      assert(read(copy).isRight)

  test("damaged files are read or refused, never anything else", Slow):
    val random = Random(3)
    val grids = Vector(VdbGrid("density", Map((0, 0, 0) -> 1f, (0, 0, 130) -> 2f)))
    val (file, zipped) = (NanoVdb.file(grids), NanoVdb.file(grids, zipped = true))
    val body = 200
    val root = body + 672 + 64
    // Where a number means something, and by how much to miss it
    val places = Vector(
      0 -> 200,
      body -> 672,
      body + 672 -> 64,
      root -> 96,
      root + 96 + 4128 -> 64,
      root + 96 + 8256 -> 64,
      root + 96 + 270400 + 544 -> 64,
      root + 96 + 270400 + 1088 -> 64
    )
    val outcomes =
      for i <- 0 until 1500 yield
        val copy = (if i % 5 == 0 then zipped else file).clone
        for _ <- 0 to random.nextInt(3) do
          val (from, length) =
            if i % 5 == 0 then (0, copy.length) else places(random.nextInt(places.size))
          copy(from + random.nextInt(length)) = random.nextInt(4) match
            case 0 => 0
            case 1 => -1
            case 2 => 127
            case _ => random.nextInt().toByte
        val damaged =
          if random.nextInt(10) == 0 then copy.take(random.nextInt(copy.length)) else copy
        // Grids are not kept: some are large
        try read(damaged).isRight
        catch case _: NanoVdbError => false
    assert(outcomes.contains(true) && outcomes.contains(false))

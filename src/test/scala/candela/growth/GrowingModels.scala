package candela.growth

import candela.scenefile.Dialect

import java.nio.charset.StandardCharsets.ISO_8859_1
import java.nio.file.{Files, Path}
import java.nio.{ByteBuffer, ByteOrder}

/** Many of what models in OBJ, PLY and STL consist of. */
object GrowingModels:
  private def row(name: String, suffix: String)(text: Int => String): Growing =
    withFiles(name, suffix)((_, count) => text(count))

  private def withFiles(name: String, suffix: String)(text: (Path, Int) => String): Growing =
    val label = s"${suffix.toUpperCase}: $name"
    Growing(label, Dialect.Gltf, size = 1000, suffix = Some(suffix))(text)

  private def lines(parts: Iterator[String]*): String =
    parts.reduce(_ ++ _).mkString("", "\n", "\n")

  private def points(count: Int) = (0 until count).iterator.map(i => s"$i ${i % 2} ${i % 3}")

  /** Binary numbers, whose bytes are characters. */
  private def packed(size: Int)(put: ByteBuffer => Unit): String =
    val bytes = ByteBuffer.allocate(size).order(ByteOrder.LITTLE_ENDIAN)
    put(bytes)
    String(bytes.array, ISO_8859_1)

  private def header(format: String, vertices: Int, more: String*): Iterator[String] =
    Iterator("ply", s"format $format 1.0", s"element vertex $vertices") ++
      "xyz".iterator.map(c => s"property float $c") ++ more ++ Iterator("end_header")

  private def faces(count: Int) =
    Seq(s"element face $count", "property list uchar int vertex_indices")

  private def obj(count: Int, corner: Int => String) = (1 to count).iterator.map: i =>
    s"f ${corner(i)} ${corner(i + 1)} ${corner(i + 2)}"

  val rows: Vector[Growing] = Vector(
    row("triangles", "obj")(n => lines(points(n + 2).map("v " + _), obj(n, i => s"$i"))),
    row("corners", "obj"): n =>
      val uvs = (0 until n + 2).iterator.map(i => s"vt ${Growing.share(i, n + 2)} 0")
      lines(points(n + 2).map("v " + _), uvs, obj(n, i => s"$i/${n + 3 - i}"))
    ,
    row("smoothing groups", "obj"): n =>
      val groups = obj(n, i => s"$i").zipWithIndex.flatMap((f, i) => Iterator(s"s ${i + 1}", f))
      lines(points(n + 2).map("v " + _), groups)
    ,
    row("corners of a face", "obj"): n =>
      val circle = (0 until n).iterator.map: i =>
        val angle = 2 * Math.PI * i / n
        s"v ${Math.cos(angle)} ${Math.sin(angle)} 0"
      lines(circle, Iterator((1 to n).mkString("f ", " ", "")))
    ,
    withFiles("materials", "obj"): (folder, n) =>
      val materials = (0 until n).iterator.map(i => s"newmtl m$i\nKd ${Growing.share(i, n)} 0 0")
      Files.writeString(folder.resolve("a.mtl"), lines(materials)): Unit
      val uses = obj(n, i => s"$i").zipWithIndex.flatMap((f, i) => Iterator(s"usemtl m$i", f))
      lines(Iterator("mtllib a.mtl"), points(n + 2).map("v " + _), uses)
    ,
    row("triangles", "ply"): n =>
      val triangles = (0 until n).iterator.map(i => s"3 $i ${i + 1} ${i + 2}")
      lines(header("ascii", n + 2, faces(n)*), points(n + 2), triangles)
    ,
    row("quads of colours and coordinates", "ply"): n =>
      val colors = Seq("red", "green", "blue").map(c => s"property uchar $c")
      val more = colors ++ faces(n) :+ "property list uchar float texcoord"
      val quads = (0 until n).iterator.map: i =>
        s"4 $i ${i + 1} ${i + 3} ${i + 2} 8 0 0 ${Growing.share(i, n)} 0 1 1 0 1"
      lines(header("ascii", n + 3, more*), points(n + 3).map(p => s"$p 9 99 200"), quads)
    ,
    row("corners of a strip", "ply"): n =>
      val strip = Seq("element tristrips 1", "property list int int vertex_indices")
      val corners = Iterator((0 until n).mkString(s"$n ", " ", ""))
      lines(header("ascii", n, strip*), points(n), corners)
    ,
    row("binary triangles", "ply"): n =>
      lines(header("binary_little_endian", n + 2, faces(n)*)) + packed(12 * (n + 2) + 13 * n): b =>
        for i <- 0 until n + 2 do
          for x <- Seq(i, i % 2, i % 3) do b.putFloat(x.toFloat)
        for i <- 0 until n do b.put(3.toByte).putInt(i).putInt(i + 1).putInt(i + 2)
    ,
    row("triangles", "stl"): n =>
      val facets = (0 until n).iterator.map: i =>
        s"facet normal 0 0 1 outer loop vertex $i 0 0 vertex ${i + 1} 0 0 vertex $i 1 0 endloop " +
          "endfacet"
      lines(Iterator("solid"), facets, Iterator("endsolid"))
    ,
    row("binary triangles", "stl"): n =>
      packed(84 + 50 * n): b =>
        b.position(80).putInt(n)
        for i <- 0 until n do
          for x <- Seq(0, 0, 1, i, 0, 0, i + 1, 0, 0, i, 1, 0) do b.putFloat(x.toFloat)
          b.putShort((0x8000 + i % 32).toShort)
  )

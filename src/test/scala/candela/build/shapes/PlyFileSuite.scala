package candela.build.shapes

import candela.diagnostics.{SceneError, SourcePos}
import candela.io.InputFile
import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

import candela.scenefile.Source
import candela.testing.Gzip
import org.scalatest.funsuite.AnyFunSuite

class PlyFileSuite extends AnyFunSuite:

  private def mesh(bytes: Array[Byte]): PlyMesh = PlyFile.mesh(Source("m.ply", bytes), None)
  private def mesh(text: String): PlyMesh = mesh(text.getBytes("ISO-8859-1"))
  private def error(text: String): String =
    intercept[SceneError](mesh(text)).problems.map(_.message).mkString

  private def header(format: String, vertices: Int, faces: Int): String =
    s"""ply
       |format $format 1.0
       |comment made by hand
       |element vertex $vertices
       |property float x
       |property float y
       |property float z
       |element face $faces
       |property list uchar int vertex_indices
       |end_header
       |""".stripMargin

  private val NormalYz = "property float ny\nproperty float nz\n"
  private val corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n"

  /** A header and the bytes that `write` puts in. */
  private def binary(head: String, order: ByteOrder)(write: ByteBuffer => Unit): Array[Byte] =
    val body = ByteBuffer.allocate(1000).order(order)
    write(body)
    head.getBytes("ISO-8859-1") ++ body.array.take(body.position)

  private def big(head: String)(write: ByteBuffer => Unit): Array[Byte] =
    binary(head, ByteOrder.BIG_ENDIAN)(write)

  test("a quad is the triangles 0 1 2 and 3 0 2, a pentagon a fan"):
    val quad = mesh(header("ascii", 4, 1) + corners + "4 0 1 2 3\n")
    assert(quad.positions.toVector == Vector(0f, 0f, 0f, 1f, 0f, 0f, 1f, 1f, 0f, 0f, 1f, 0.5f))
    assert(quad.indices.toVector == Vector(0, 1, 2, 3, 0, 2))
    assert(quad.normals.isEmpty && quad.uvs.isEmpty)
    val pentagon = mesh(header("ascii", 4, 1) + corners + "5 0 1 2 3 1")
    assert(pentagon.indices.toVector == Vector(0, 1, 2, 0, 2, 3, 0, 3, 1))

  test("faces of fewer than three corners are left out"):
    val m = mesh(header("ascii", 4, 3) + corners + "2 0 1\n3 1 2 3\n0\n")
    assert(m.indices.toVector == Vector(1, 2, 3))

  test("the first line shows how lines end"):
    val text = header("ascii", 4, 1) + corners + "3 0 1 2\n"
    for end <- List("\r\n", "\r") do
      assert(mesh(text.replace("\n", end)).indices.toVector == Vector(0, 1, 2))

  private val rich =
    """element lamp 1
      |property double watts
      |property list uchar double extra
      |element vertex 3
      |property double x
      |property short y
      |property list uint16 int8 weights
      |property float z
      |property float nx
      |property float ny
      |property float nz
      |property float s
      |property float t
      |property uchar red
      |element face 1
      |property int group
      |property list ushort uint vertex_index
      |property float area
      |element edge 2
      |property int from
      |end_header
      |""".stripMargin

  private def writeRich(out: ByteBuffer): Unit =
    out.putDouble(60).put(2.toByte).putDouble(1).putDouble(2)
    for i <- 0 until 3 do
      out.putDouble(i + 0.25).putShort((-i).toShort).putShort(i.toShort)
      for k <- 0 until i do out.put((-k).toByte)
      for value <- List(2f, 0f, 0f, 1f, i * 0.5f, i * 0.25f) do out.putFloat(value)
      out.put(255.toByte)
    out.putInt(7).putShort(3).putInt(2).putInt(1).putInt(0).putFloat(0.5f).putInt(0).putInt(1)
    ()

  private def checkRich(m: PlyMesh): Unit =
    assert(m.positions.toVector == Vector(0.25f, 0f, 2f, 1.25f, -1f, 2f, 2.25f, -2f, 2f))
    assert(m.normals.toVector == Vector(0f, 0f, 1f, 0f, 0f, 1f, 0f, 0f, 1f))
    assert(m.uvs.toVector == Vector(0f, 0f, 0.5f, 0.25f, 1f, 0.5f))
    assert(m.indices.toVector == Vector(2, 1, 0))
    ()

  test("both byte orders are read, and other elements, properties and lists passed over"):
    checkRich(mesh(big(s"ply\nformat binary_big_endian 1.0\n$rich")(writeRich)))
    val little = s"ply\nformat binary_little_endian 1.0\n$rich"
    checkRich(mesh(binary(little, ByteOrder.LITTLE_ENDIAN)(writeRich)))

  test("numbers of every type have all their values, with the sign of the type"):
    val types = Vector("char", "uchar", "short", "ushort", "int", "uint", "float", "double")
    val values = Vector(-128.0, 255.0, -32768.0, 65535.0, -2147483648.0, 4294967040.0, 0.25, 0.1)
    for (name, value) <- types.zip(values); order <- Vector("big", "little") do
      val head = s"ply\nformat binary_${order}_endian 1.0\nelement vertex 3\nproperty $name x\n" +
        "property float y\nproperty float z\nelement face 1\nproperty list uchar int i\n" +
        "end_header\n"
      val to = if order == "big" then ByteOrder.BIG_ENDIAN else ByteOrder.LITTLE_ENDIAN
      val bytes = binary(head.replace("int i", "int vertex_indices"), to): out =>
        for i <- 0 until 3 do
          name match
            case "char" | "uchar" => out.put(value.toInt.toByte)
            case "short" | "ushort" => out.putShort(value.toInt.toShort)
            case "int" | "uint" => out.putInt(value.toLong.toInt)
            case "float" => out.putFloat(value.toFloat)
            case _ => out.putDouble(value)
          out.putFloat(i.toFloat).putFloat(0f)
        out.put(3.toByte).putInt(0).putInt(1).putInt(2): Unit
      assert(mesh(bytes).positions(0) == value.toFloat, s"$name, $order endian")

  test("a mesh with all its properties is the same in ASCII"):
    checkRich(
      mesh(
        s"ply\nformat ascii 1.0\n$rich" + "60 2 1 2\n0.25 0 0 2 0 0 1 0 0 255\n" +
          "1.25 -1 1 0 2 0 0 1 .5 .25 255\n2.25 -2 2 0 -1 2 0 0 1 1 .5 255\n7 3 2 1 0 .5\n0\n1"
      )
    )

  test("the window through which a file is read makes no difference"):
    val bytes = big(s"ply\nformat binary_big_endian 1.0\n$rich")(writeRich)
    val text = header("ascii", 4, 1) + corners + "4 0 1 2 3 \n\n"
    for room <- 1 to 80 do
      checkRich(PlyFile.mesh(Source.windowed("m.ply", bytes, room), None))
      val ascii = PlyFile.mesh(Source.windowed("m.ply", text.getBytes("ISO-8859-1"), room), None)
      assert(ascii.indices.toVector == Vector(0, 1, 2, 3, 0, 2))

  test("texture coordinates go by four pairs of names; half a pair is none"):
    def uvs(names: String*) =
      val extra = names.map(n => s"property float $n\n").mkString
      val head = header("ascii", 3, 1).replace("element face", extra + "element face")
      mesh(head + "0 0 0 .1 .2\n1 0 0 .3 .4\n0 1 0 .5 .6\n3 0 1 2").uvs.toVector
    val all = Vector(0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f)
    assert(uvs("u", "v") == all && uvs("s", "t") == all)
    assert(uvs("texture_u", "texture_v") == all && uvs("texture_s", "texture_t") == all)
    assert(uvs("v", "u") == Vector(0.2f, 0.1f, 0.4f, 0.3f, 0.6f, 0.5f))
    assert(uvs("u", "weight").isEmpty)

  test("a header that claims more than the file can hold takes no memory"):
    val file = Files.createTempFile("mesh", ".ply")
    try
      Files.write(file, header("ascii", 2_000_000_000, 400_000_000).getBytes("ISO-8859-1"))
      val size = PlySize.guess(InputFile.named(file)).get
      assert(size.vertices <= Files.size(file) && size.faces <= Files.size(file), size)
      val error = intercept[SceneError](PlyFile.read(InputFile.named(file)))
      assert(
        error.problems.head.message.contains("the file is too short for its 2000000000 vertex")
      )
    finally Files.delete(file)

  test("gzipped files are read"):
    val file = Files.createTempFile("mesh", ".ply.gz")
    try
      val mesh = header("ascii", 4, 1) + corners + "3 0 1 2\n"
      Files.write(file, Gzip.of(mesh.getBytes("ISO-8859-1")))
      assert(PlyFile.read(InputFile.named(file)).indices.toVector == Vector(0, 1, 2))
    finally Files.delete(file)

  test("a file that is not there is an error at the place that asks for it"):
    val at = SourcePos("scene.pbrt", 3, 4)
    val error = intercept[SceneError](PlyFile.read(InputFile.named(Path.of("no.ply")), Some(at)))
    val problem = error.problems.head
    assert(problem.pos.contains(at))
    assert(problem.message == "can't read the mesh `no.ply`: no such file")

  test("a header that makes no sense is an error that shows the line"):
    assert(error("solid\n").contains("line 1: not a PLY file") && !error("solid\n").contains("OBJ"))
    for obj <- Seq("# made by hand\n", "v 0 0 0\n", "mtllib a.mtl\n") do
      assert(error(obj).contains("it looks like OBJ: `candela convert`"), obj)
    assert(error("ply\nformat ascii 1.0\n").contains("must end with `end_header`"))
    assert(error("ply\nformat utf8 1.0\n").contains("line 2: unknown format: `format utf8 1.0`"))
    assert(error("ply\nformat a\u0007b\n").endsWith("`format a?b`"))
    assert(error("ply\nelement vertex -3\n").contains("line 2: invalid count"))
    assert(error("ply\nelement vertex 9999999999\n").contains("line 2: invalid count"))
    assert(error("ply\nelement vertex 3\nproperty half x\n").contains("line 3: unknown property"))
    assert(error("ply\nproperty float x\n").contains("line 2: unknown header line"))

  test("missing elements and properties are named, with what is there instead"):
    val noFaces = header("ascii", 4, 1).replace("element face", "element tristrips")
    val instead = "the file must have face elements, found 4 vertex, 1 tristrips"
    assert(error(noFaces + corners).contains(instead))
    assert(error(header("ascii", 0, 1)).contains("must have vertex elements"))
    val noZ = header("ascii", 4, 1).replace("float z", "float height")
    val lacking = "must have `x`, `y` and `z`, found `x`, `y`, `height`"
    assert(error(noZ + corners + "3 0 1 2").contains(lacking))
    val noCorners = header("ascii", 4, 1).replace("vertex_indices", "corners")
    assert(error(noCorners + corners + "3 0 1 2").contains("must have a list `vertex_indices`"))

  test("a corner that is no vertex is an error with its line"):
    for corner <- List("4", "-1", "1.5") do
      assert(
        error(header("ascii", 4, 1) + corners + s"3 0 1 $corner") ==
          s"mesh `m.ply`, line 15: the vertex index of a face must be between 0 and 3, found " +
          corner
      )

  test("positions that are not finite are errors; normals that are not finite become 0"):
    val huge = header("ascii", 4, 1) + corners.replace("0.5", "1e99") + "3 0 1 2"
    assert(error(huge).contains("line 14: `z` of vertex 3 must be finite, found Infinity"))
    val notNumber = header("ascii", 4, 1) + corners.replace("0.5", "nan") + "3 0 1 2"
    assert(error(notNumber).contains("expected a number"))
    val head = "ply\nformat binary_big_endian 1.0\n" + rich
    val bytes = big(head)(writeRich)
    val nan = big("")(b =>
      val _ = b.putFloat(Float.NaN)
    )
    val z = big("")(b =>
      val _ = b.putFloat(2f)
    )
    val normal = big("")(b =>
      val _ = b.putFloat(1f)
    )
    val body = head.length + 25
    val firstZ = bytes.indexOfSlice(z, body)
    val message = intercept[SceneError](mesh(bytes.patch(firstZ, nan, 4))).problems.head.message
    assert(message == s"mesh `m.ply`, byte $firstZ: `z` of vertex 0 must be finite, found NaN")
    val m = mesh(bytes.patch(bytes.indexOfSlice(normal, firstZ), nan, 4))
    assert(m.normals.take(3).toVector == Vector(0f, 0f, 0f))

  test("a binary mesh is read alike by rows and number by number, through any window"):
    // what else a vertex or a face has makes them unusual: no rows, no plain triangles
    def head(vertex: String, face: String) =
      header("binary_little_endian", 40, 30)
        .replace("property float z\n", s"property float z\nproperty float nx\n$NormalYz$vertex")
        .replace("vertex_indices\n", s"vertex_indices\n$face")
    def bytes(isUsual: Boolean) =
      val h = if isUsual then head("", "") else head("property uchar a\n", "property uchar b\n")
      val body = ByteBuffer.allocate(4000).order(ByteOrder.LITTLE_ENDIAN)
      for i <- 0 until 40 do
        for k <- 0 until 6 do
          body.putFloat(if k == 4 && i % 7 == 3 then Float.NaN else i * 0.3f - k): Unit
        if !isUsual then body.put(1.toByte): Unit
      for i <- 0 until 30 do
        val count = if i % 5 == 2 then 4 else if i % 11 == 4 then 2 else 3
        body.put(count.toByte)
        for k <- 0 until count do body.putInt((7 * i + k) % 40): Unit
        if !isUsual then body.put(2.toByte): Unit
      h.getBytes("ISO-8859-1") ++ body.array.take(body.position)
    def numbers(m: PlyMesh) =
      (m.positions.toVector, m.normals.toVector, m.indices.toVector, m.quads.toVector)
    val slow = mesh(bytes(isUsual = false))
    assert(slow.normals(3 * 3 + 1) == 0f && slow.indices.length == 3 * (30 + 6 - 3))
    assert(numbers(mesh(bytes(isUsual = true))) == numbers(slow))
    for room <- Seq(3, 17, 50) do
      val through = PlyFile.mesh(Source.windowed("m", bytes(isUsual = true), room), None)
      assert(numbers(through) == numbers(slow), s"a window of $room bytes")

  test("a file that was cut anywhere is an error, never another mesh"):
    val ascii = (header("ascii", 4, 1) + corners + "4 0 1 2 3").getBytes("ISO-8859-1")
    val bytes = big(s"ply\nformat binary_big_endian 1.0\n$rich")(writeRich)
    for whole <- List(ascii, bytes); length <- 0 until whole.length do
      intercept[SceneError](mesh(whole.take(length)))

  test("counts beyond the file's size are refused before any memory is taken for them"):
    val counts = List((2000000000, 1), (4, 2000000000))
    for format <- List("ascii", "binary_little_endian", "binary_big_endian"); (v, f) <- counts do
      val body = if format == "ascii" then corners + "3 0 1 2\n" else "x" * 61
      val message = error(header(format, v, f) + body)
      assert(message.contains("the file is too short for its 2000000000"))
    val list = header("binary_big_endian", 1, 1).replace("uchar int", "int int")
    val start = list + "\u0000" * 12
    assert(error(start + "\u0040" + "\u0000" * 11).contains("unexpected end of file"))
    assert(error(start + "\u00ff\u00ff\u00ff\u00fezzzz").contains("invalid list length -2"))

  test("whatever byte of a file is changed, the answer is a sound mesh or a SceneError"):
    val ascii = (header("ascii", 4, 1) + corners + "4 0 1 2 3").getBytes("ISO-8859-1")
    val bytes = big(s"ply\nformat binary_big_endian 1.0\n$rich")(writeRich)
    val random = scala.util.Random(1)
    for whole <- List(ascii, bytes); i <- whole.indices do
      try
        val m = mesh(whole.updated(i, random.nextInt(256).toByte))
        assert(m.indices.forall(v => v >= 0 && v * 3 < m.positions.length))
        assert(m.positions.forall(java.lang.Float.isFinite))
      catch case e: SceneError => assert(e.problems.nonEmpty)

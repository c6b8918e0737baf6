package candela.mitsuba

import candela.diagnostics.{SceneError, SourcePos}
import candela.io.InputFile
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class MeshFilesSuite extends AnyFunSuite:
  private val at = SourcePos("scene.xml", 1, 1)
  private val folder = Path.of("scenes", "mitsuba")

  private def written[A](bytes: Array[Byte])(use: InputFile => A): A =
    val file = Files.createTempFile("candela", ".mesh")
    try use(InputFile.named(Files.write(file, bytes)))
    finally Files.delete(file)

  private def obj(text: String): Mesh =
    written(text.getBytes("UTF-8"))(ObjShape.read(_, flipped = false, at))
  private def why(body: => Any): String = intercept[SceneError](body).problems.head.message

  test("a corner of a face is a vertex of its own combination of indices"):
    val mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n" +
      "f 1/1 2/1 3/2 4/2\nf 1/1 2/1 -2/2\n")
    assert(mesh.indices.toVector == Vector(0, 1, 2, 0, 2, 3, 0, 1, 2))
    assert(mesh.positions.length == 12)
    assert(mesh.uvs.toVector == Vector(0f, 0f, 0f, 0f, 1f, 1f, 1f, 1f))
    assert(mesh.normals.isEmpty)

  test("faults of an OBJ file are reported with its line"):
    assert(why(
      obj("v 0 0 0\nf 1 2 3\n")
    ).endsWith("line 2: an index of the corner `3` is out of range: vertices are 1 to 1"))
    assert(why(obj("v 0 x 0\n")).endsWith("line 1: expected a number, found `x`"))
    assert(why(obj("v 0 0 0\n")).endsWith("it has no faces"))

  test("the same tent as OBJ and as serialized mesh"):
    val a = ObjShape.read(InputFile.named(folder.resolve("tent.obj")), flipped = false, at)
    val b = SerializedFile.read(InputFile.named(folder.resolve("tent.serialized")), 0, at)
    def corners(m: Mesh) =
      m.indices.toVector.map(i => m.positions.slice(3 * i, 3 * i + 3).toVector)
    assert(corners(a).toSet == corners(b).toSet)
    assert(a.indices.length == 12 && b.indices.length == 12)

  test("a serialized mesh that claims more than it can hold is refused"):
    val good = Files.readAllBytes(folder.resolve("tent.serialized"))
    assert(why(written(good.take(40))(SerializedFile.read(_, 0, at))).contains("damaged"))
    val tent = InputFile.named(folder.resolve("tent.serialized"))
    assert(why(SerializedFile.read(tent, 1, at)).contains("1 meshes"))
    val claim = java.nio.ByteBuffer.allocate(21).order(java.nio.ByteOrder.LITTLE_ENDIAN)
    val file = packed(claim.putInt(0x1000).put(0.toByte).putLong(700_000_000L).putLong(1L).array)
    assert(why(written(file)(SerializedFile.read(_, 0, at))).contains("more than it can hold"))

  /** A `.serialized` file of one mesh. */
  private def packed(mesh: Array[Byte]): Array[Byte] =
    val body = java.io.ByteArrayOutputStream()
    val zip = java.util.zip.DeflaterOutputStream(body)
    zip.write(mesh)
    zip.close()
    val file =
      java.nio.ByteBuffer.allocate(body.size + 16).order(java.nio.ByteOrder.LITTLE_ENDIAN)
    file.putShort(0x041c).putShort(4).put(body.toByteArray).putLong(0L).putInt(1).array

  /** A file of one triangle, with the arrays that the flags name. */
  private def serialized(flags: Int, arrays: Vector[Float]*): Array[Byte] =
    val plain =
      java.nio.ByteBuffer.allocate(4 + 1 + 16 + arrays.map(4 * _.size).sum + 12)
        .order(java.nio.ByteOrder.LITTLE_ENDIAN)
    plain.putInt(0x1000 | flags).put(0.toByte).putLong(3L).putLong(1L): Unit
    arrays.flatten.foreach(plain.putFloat)
    for i <- Vector(2, 0, 1) do plain.putInt(i)
    packed(plain.array)

  test("arrays of a serialized mesh follow each other as its flags say, colours too"):
    val p = Vector(0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f, 0f)
    val n = Vector.fill(3)(Vector(0f, 0f, 1f)).flatten
    val uv = Vector(0f, 0f, 1f, 0f, 0f, 1f)
    val colours = Vector.fill(9)(0.25f)
    for (flags, arrays) <- Vector(
        (0, Vector(p)),
        (1, Vector(p, n)),
        (2, Vector(p, uv)),
        (8, Vector(p, colours)),
        (1 | 2 | 8, Vector(p, n, uv, colours))
      )
    do
      val mesh = written(serialized(flags, arrays*))(SerializedFile.read(_, 0, at))
      assert(mesh.positions.toVector == p, flags)
      assert(mesh.normals.toVector == (if (flags & 1) != 0 then n else Vector.empty), flags)
      assert(mesh.uvs.toVector == (if (flags & 2) != 0 then uv else Vector.empty), flags)
      assert(mesh.indices.toVector == Vector(2, 0, 1), flags)

  test("vertex normals are the triangles', weighted by angle"):
    // A cube's corner: three right angles, whatever the number of triangles
    val cube = Mesh(
      Array(0f, 0f, 0f, 1f, 0f, 0f, 1f, 1f, 0f, 0f, 1f, 0f, 0f, 0f, 1f, 1f, 0f, 1f, 0f, 1f, 1f),
      Array.emptyFloatArray,
      Array.emptyFloatArray,
      Array(0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 0, 4, 6, 0, 6, 3)
    )
    val n = cube.smooth.normals.take(3)
    n.foreach(c => assert(Math.abs(c + 1 / Math.sqrt(3)) < 1e-6))

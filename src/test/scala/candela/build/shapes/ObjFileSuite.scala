package candela.build.shapes

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import candela.io.InputFile
import candela.testing.{Gzip, TempFolder}

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class ObjFileSuite extends AnyFunSuite:
  private def mesh(bytes: Array[Byte]): ObjMesh =
    TempFolder.use: folder =>
      val file = Files.write(folder.resolve("m.obj"), bytes)
      ObjFile.read(InputFile.named(file)): (line, column, message) =>
        throw SceneError(Problem.error(Code.DamagedMesh, SourcePos("m", line, column), message))

  private def mesh(text: String): ObjMesh = mesh(text.getBytes("UTF-8"))

  private def error(text: String): String =
    val p = intercept[SceneError](mesh(text)).problems.head
    s"${p.pos.get.line}:${p.pos.get.column}: ${p.message}"

  private val Points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

  test("corners have indices of position, coordinates and normal, also from the end"):
    val m = mesh(Points + "vt 0.25 0.5\nvt 1\nvn 0 0 1\nf 1/1/1 2//1 3/-1 -1\n")
    assert(m.corners.toVector == Vector(0, 0, 0, 1, -1, 0, 2, 1, -1, 3, -1, -1))
    assert(m.uvs.toVector == Vector(0.25f, 0.5f, 1f, 0f) && m.normals.length == 3)

  test("vertices may follow the faces that name them"):
    val m = mesh("f 1//1 2//1 3//1\n" + Points + "vn 0 0 1\n")
    assert(m.corners.toVector == Vector(0, -1, 0, 1, -1, 0, 2, -1, 0))
    assert(error("v 0 0 0\nf 1 2 4 # all\nf 1 2 3\nv 1 0 0\nv 0 1 0\n") ==
      "2:7: an index of the corner `4` is out of range: vertices are 1 to 3")

  test("normals of which a file has none are left out"):
    val m = mesh(Points + "f 1/1/2 2/1/2 3/1/2\n")
    assert((0 until 3).forall(c => m.normal(c) < 0 && m.uv(c) < 0))
    assert(m.omitted.map(p => (p.text.take(18), p.line)) ==
      Vector(("indices of texture", 5), ("indices of normals", 5)))

  test("runs of faces have a material and a smoothing group"):
    val m = mesh(Points + "f 1 2 3\nusemtl a b\ns 2\nf 1 2 3\nf 1 3 4\ng x\ns off\nf 1 2 4\n")
    assert(m.runs.map(r => (r.firstFace, r.material.map(_.text), r.smoothing)) ==
      Vector((0, None, 0), (1, Some("a b"), 2), (3, Some("a b"), 0)))

  test("vertices have colours, a weight or neither"):
    val m = mesh("v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 0.7\nf 1 2 3\n")
    assert(m.colors.toVector == Vector(1f, 1f, 1f, 1f, 0.5f, 0f, 1f, 1f, 1f))
    assert(mesh(Points + "f 1 2 3\n").colors.isEmpty)

  test("digits that Floats lack of large coordinates are there"):
    val m = mesh("v 100000.03125 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert(m.positions(0).toDouble + (if m.rests.isEmpty then 0f else m.rests(0)) == 100000.03125)
    val far = mesh("v 123456.7891 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert(Math.abs(far.positions(0).toDouble + far.rests(0) - 123456.7891) < 1e-8)

  test("what is left out is known by its first place"):
    val m = mesh(Points + "l 1 2\nl 2 3\nvn nan 0 1\nf 1 2\nf 1 2 3\n\\\n  zz 1")
    assert(m.omitted.map(p => (p.text, p.line, p.column)) == Vector(
      ("l", 5, 1),
      (ObjFile.Undefined, 7, 4),
      (ObjFile.Slivers, 8, 1),
      ("zz", 10, 5)
    ))

  test("faults have a line and a column"):
    assert(error("v 0 x 0\n") == "1:5: expected a number, found `x`")
    assert(error("v 0 0\n") == "1:6: expected a number, found the end of the line")
    assert(error("v 0 0 1e99\n") == "1:7: expected a finite number, found `1e99`")
    assert(error(Points + "f 1 2 0\n") ==
      "5:7: an index of the corner `0` is out of range: vertices are 1 to 4")
    assert(error(Points + "f 1 2 -5\n").contains("`-5` is out of range"))
    assert(error(Points + "f 1 2 3/a\n") == "5:7: expected a face's corner, found `3/a`")
    assert(error(Points + "f 1 2 99999999999\n").contains("out of range"))
    assert(error(Points + "s smooth\nf 1 2 3\n").startsWith("5:3: expected the number of a smooth"))
    assert(error(Points + "l 1 2\np 1\n") == "0:0: it has no faces, only `l`, `p`")
    assert(error("\u0000\u0001\u0002").contains("it has no faces"))

  test("files of any size may be compressed"):
    val text = Points * 20000 + "f 1 2 3\n" * 20000
    val m = mesh(Gzip.of(text.getBytes("UTF-8")))
    assert(m.faces == 20000 && m.positions.length == 3 * 80000)

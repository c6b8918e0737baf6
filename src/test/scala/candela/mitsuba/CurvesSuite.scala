package candela.mitsuba

import candela.diagnostics.{SceneError, SourcePos}
import candela.io.InputFile
import candela.math.*

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class CurvesSuite extends AnyFunSuite:

  private def read(text: String, least: Int = 2): Vector[CurvePoints] =
    val file = Files.createTempFile("candela", ".txt")
    try CurveFile.read(
        InputFile.named(Files.writeString(file, text)),
        least,
        SourcePos("scene.xml", 1, 1)
      )
    finally Files.delete(file)

  private def vertices(m: Mesh): Vector[Vec3] = vectors(m.positions)
  private def vectors(values: Array[Float]): Vector[Vec3] =
    values.grouped(3).map(v => Vec3(v(0), v(1), v(2))).toVector

  private val straight =
    CurvePoints(Vector.tabulate(5)(i => Vec3(i.toFloat, 0f, 0f)), Vector.fill(5)(0.5f))

  test("empty lines part the curves of a file"):
    val found = read("0 0 0 1\n1 0 0 2\n\n \n0 1 0 .5\r\n1 1 0 .5\n2 1 0 .5")
    assert(found.map(_.points.size) == Vector(2, 3))
    assert(found.head.radii == Vector(1f, 2f))

  test("broken files of curves are errors with their line"):
    def why(text: String, least: Int = 2) =
      intercept[SceneError](read(text, least)).problems.head.message.replaceAll(".*`: ", "")
    assert(why("0 0 0 1\n1 2 3\n") == "line 2 must have x, y, z and a radius, found `1 2 3`")
    assert(why("0 0 0 -1\n1 2 3 1") == "line 1 must have x, y, z and a radius, found `0 0 0 -1`")
    assert(why("0 0 0 1e30\n1 2 3 1").startsWith("line 1 must have"))
    assert(why("0 0 0 nan\n1 2 3 1").startsWith("line 1 must have"))
    assert(why("0 0 0 1\n0 0 1 1\n", 4) == "the curve before line 3 has 2 points; it needs 4")
    assert(why("\n\n") == "it has no curve")

  test("the tube of a spline is open, as wide as its radius, with normals outward"):
    val mesh = Tubes.splines(Vector(straight))
    val all = vertices(mesh)
    assert(all.map(_.x).min == 1f && all.map(_.x).max == 3f)
    for (p, n) <- all.zip(vectors(mesh.normals)) do
      val out = Vec3(0f, p.y, p.z)
      // Polygons are as long as their circles: 32 corners lie 0.16 % outside
      assert(Math.abs(out.length - 0.5f) < 0.002f)
      assert((n - out.normalized).length < 1e-5f)
    for t <- mesh.indices.grouped(3) do
      val Array(a, b, c) = t.map(all(_)): @unchecked
      assert((((b - a) cross (c - a)) dot Vec3(0f, a.y + b.y + c.y, a.z + b.z + c.z)) > 0f)

  test("u begins where Mitsuba's does, and v runs over all curves"):
    val above = straight.copy(points = straight.points.map(_ + Vec3(0f, 0f, 9f)))
    val mesh = Tubes.splines(Vector(straight, above))
    val uvs = mesh.uvs.grouped(2).map(v => (v(0), v(1))).toVector
    val first = vertices(mesh).zip(uvs).find(_._2 == (0.25f, 0f)).get._1
    // A quarter of a turn points along z
    assert((first - Vec3(1f, 0f, 0.5f)).length < 0.01f, first)
    assert(uvs.map(_._2).max == 1f && uvs.count(_._2 == 0.5f) > 0)

  test("a tube that widens has normals that lean back"):
    val cone = straight.copy(radii = Vector(1f, 2f, 3f, 4f, 5f))
    val mesh = Tubes.splines(Vector(cone))
    for n <- vectors(mesh.normals) do assert(Math.abs(n.x + Math.sqrt(0.5)) < 1e-5)

  test("straight pieces are capsules: no point is nearer or farther than the radius"):
    val pieces = CurvePoints(Vector(Vec3.Zero, Vec3(0f, 0f, 2f)), Vector(0.5f, 0.25f))
    val mesh = Tubes.capsules(Vector(pieces))
    val all = vertices(mesh)
    assert(Math.abs(all.map(_.z).min + 0.5f) < 1e-5f && Math.abs(all.map(_.z).max - 2.25f) < 1e-5f)
    // The normal leads to the axis, after the radius there
    for (p, n) <- all.zip(vectors(mesh.normals)) do
      val foot = if p.z < 1f then Vec3.Zero else Vec3(0f, 0f, 2f)
      assert(Math.abs((p - foot).length - (if p.z < 1f then 0.5f else 0.25f)) < 0.002f, p)
      assert((n - (p - foot).normalized).length < 0.01f, p)

  test("many segments share the triangles"):
    val many = Tubes.splines(Vector.fill(20000)(straight))
    assert(many.indices.length / 3 < 3000000)

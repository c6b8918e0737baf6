package candela.models

import candela.models.MeshFormats.*
import candela.scenefile.SceneDescription

import org.scalatest.funsuite.AnyFunSuite

class PlyFormatSuite extends AnyFunSuite:
  private def model(properties: String, vertices: String, faces: String, more: String = "") =
    val count = faces.linesIterator.size
    read(Seq("m.ply" -> bytes(
      s"""ply
         |format ascii 1.0
         |element vertex ${vertices.linesIterator.size}
         |property float x
         |property float y
         |property float z
         |${properties}element face $count
         |property list uchar int vertex_indices
         |${more}end_header
         |$vertices
         |$faces
         |""".stripMargin
    )))

  private def colors(s: SceneDescription) = floats(s.shapes.head.shape, "colors")

  test("z points up, and surfaces without normals are flat"):
    val scene = model("", "0 0 0\n1 0 0\n0 1 0", "3 0 1 2")
    assert(scene.errors.isEmpty && floats(scene.shapes.head.shape, "N").isEmpty)
    assert(scene.additions.get.contains("z points up: --up y changes that"))
    val place = scene.shapes.head.objectToWorld.start.point(candela.math.Vec3(0, 0, 1))
    assert((place - candela.math.Vec3(0, 1, 0)).length < 1e-6f)

  test("colours are bytes or numbers from 0 to 1, in sRGB, with alpha as coverage"):
    val names = Vector("red", "green", "blue")
    def property(kind: String) = names.map(n => s"property $kind $n\n").mkString
    val ofBytes = model(property("uchar"), "0 0 0 255 128 0\n1 0 0 1 1 1\n0 1 0 0 0 0", "3 0 1 2")
    val first = colors(ofBytes).take(4)
    assert(first(0) == 1f && Math.abs(first(1) - 0.21586f) < 1e-4f && first(3) == 1f)
    assert(colors(ofBytes)(4) < 1e-3f && ofBytes.shapes.head.shape.param("alpha").isEmpty)
    val ofNumbers = model(property("float"), "0 0 0 1 0.5 0\n1 0 0 1 1 1\n0 1 0 0 0 0", "3 0 1 2")
    assert(Math.abs(colors(ofNumbers)(1) - 0.21404f) < 1e-4f)
    val veiled = model(
      property("uchar") + "property uchar alpha\n",
      "0 0 0 255 255 255 51\n1 0 0 1 1 1 255\n0 1 0 0 0 0 255",
      "3 0 1 2"
    )
    assert(Math.abs(colors(veiled)(3) - 0.2f) < 1e-6f)
    assert(veiled.shapes.head.shape.param("alpha").isDefined)

  test("colours of faces are those of their triangles"):
    val scene = model(
      "",
      "0 0 0\n1 0 0\n1 1 0\n0 1 0",
      "4 0 1 2 3 255 0 0\n3 0 1 2 0 0 255",
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    )
    val all = colors(scene).grouped(12).map(_.take(3)).toVector
    assert(all == Vector(Vector(1f, 0f, 0f), Vector(1f, 0f, 0f), Vector(0f, 0f, 1f)))

  test("a concave face is not filled"):
    val scene = model("", "0 0 0\n4 4 0\n0 1 0\n-4 4 0", "4 0 1 2 3")
    assert(ints(scene.shapes.head.shape, "indices").grouped(3).forall(t =>
      Set(0, 2).subsetOf(t.toSet)
    ))

  test("lists that are not read are warnings, and faults have a line"):
    val scene = model(
      "",
      "0 0 0\n1 0 0\n0 1 0",
      "3 0 1 2 6 0 0 1 0 1 1",
      "property list uchar float texcoord\n"
    )
    assert(scene.warnings.map(_.message) == Vector("`texcoord` is not supported; it is left out"))
    assert(error(model("", "0 0 0\n1 0 0\n0 1 0", "3 0 1 7")).contains("line 13"))

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
    assert(scene.additions.get.contains("z points up, turned to y: --up y changes that"))
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

  private val Square = "0 0 0\n1 0 0\n1 1 0\n0 1 0"

  test("lists that are not read are warnings, and faults have a line"):
    val scene = model("", "0 0 0\n1 0 0\n0 1 0", "3 0 1 2 1 7", "property list uchar int flags\n")
    assert(scene.warnings.map(_.message) == Vector("`flags` is not supported; it is left out"))
    assert(error(model("", "0 0 0\n1 0 0\n0 1 0", "3 0 1 7")).contains("line 13"))

  test("corners have their own coordinates, and vertices with equal ones are one"):
    val scene = model(
      "",
      Square,
      "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 2 1 6 0 0 1 1 1 0.5",
      "property list uchar float texcoord\n"
    )
    assert(scene.warnings.isEmpty)
    val shape = scene.shapes.head.shape
    val uvs = floats(shape, "uv").grouped(2).toVector
    val points = floats(shape, "P").grouped(3).map(_.take(2)).toVector
    val indices = ints(shape, "indices")
    assert(points.size == 5 && indices.size == 9)
    assert(indices.take(6).forall(i => uvs(i) == points(i)))
    assert(indices.drop(6).map(uvs) == Vector(Vector(0f, 0f), Vector(1f, 1f), Vector(1f, 0.5f)))

  test("corners without coordinates have 0, and colours of faces stay with their faces"):
    val scene = model(
      "",
      Square,
      "3 0 1 2 2 0.5 0.5 255 0 0\n3 0 2 3 0 0 0 255",
      "property list uchar float texcoord\nproperty uchar red\nproperty uchar green\n" +
        "property uchar blue\n"
    )
    val expected = Vector(0.5f, 0.5f) ++ Vector.fill(10)(0f)
    assert(floats(scene.shapes.head.shape, "uv") == expected)
    assert(colors(scene).slice(0, 3) == Vector(1f, 0f, 0f))
    assert(colors(scene).slice(12, 15) == Vector(0f, 0f, 1f))

  private def textured(comments: String, faces: String, properties: String, names: String*) =
    val png = java.util.Base64.getDecoder.decode(
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5" +
        "ErkJggg=="
    )
    val text = s"ply\nformat ascii 1.0\n${comments}element vertex 4\nproperty float x\n" +
      s"property float y\nproperty float z\n${properties}element face 2\n" +
      "property list uchar int vertex_index\nproperty list uchar float texcoord\n" +
      s"property int texnumber\nend_header\n$Square\n$faces\n"
    read(("m.ply" -> bytes(text)) +: names.map(_ -> png))

  private val Numbered = "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 1 1 0 1 0"

  test("images are those of the faces, by number, and <this> is the model's name"):
    val comments = "comment TextureFile <this>_A.png\ncomment TextureFile b c.png\n"
    val scene = textured(comments, Numbered, "", "m_A.png", "b c.png")
    assert(scene.errors.isEmpty && scene.warnings.isEmpty)
    val files = scene.textures.map(_.texture.param("filename").get.strings.head)
    assert(files == Vector("m_A.png", "b c.png"))
    val colored = scene.shapes.take(2).map: shape =>
      shape.material match
        case candela.scenefile.MaterialRef.Inline(d) =>
          d.param("reflectance").get.strings.head -> ints(shape.shape, "indices").size
        case other => fail(s"$other")
    assert(colored == Vector("texture 1" -> 3, "texture 2" -> 3))

  test("an image that is missing has a place, and a number without image is a warning"):
    val comments = "comment TextureFile a.png\ncomment TextureFile b.png\n"
    val missing = textured(comments, Numbered, "", "a.png")
    assert(missing.textures.last.texture.param("filename").get.pos.line == 4)
    val wrong = textured(comments, Numbered.replace("1 1 1\n", "1 1 7\n"), "", "a.png", "b.png")
    assert(wrong.warnings.map(_.message) ==
      Vector("faces whose `texnumber` is not one of 0 to 1 have no image"))
    val bare = read(Seq("m.ply" -> bytes(
      "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\n" +
        "property float y\nproperty float z\nelement face 1\n" +
        "property list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    )))
    assert(bare.warnings.map(_.message) ==
      Vector("the model has an image, but no texture coordinates"))

  private def strips(lines: String, indices: String = "vertex_indices") = read(Seq("m.ply" -> bytes(
    s"ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n" +
      s"property double z\nelement tristrips ${lines.linesIterator.size}\n" +
      s"property list int int $indices\nend_header\n$Square\n2 0 0\n$lines\n"
  )))

  test("triangles of strips turn alternately, and -1 begins another strip"):
    val scene = strips("4 0 1 2 3\n7 0 1 2 -1 1 4 2")
    assert(scene.warnings.isEmpty && scene.errors.isEmpty)
    assert(ints(scene.shapes.head.shape, "indices") ==
      Vector(0, 1, 2, 2, 1, 3, 0, 1, 2, 1, 4, 2))
    assert(error(strips("3 0 1 5")).contains("must be between -1 and 4, found 5"))
    assert(error(strips("3 0 1 2", "corners")).contains("tristrips must have a list"))
    assert(error(strips("2 0 1")).contains("no face has three corners"))

  test("points are refused"):
    val cloud = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n" +
      "property float z\nend_header\n0 0 0\n"
    assert(error(read(Seq("m.ply" -> bytes(cloud)))).endsWith(
      "m.ply`, line 8: the model has no faces, found 1 vertex; points are not supported"
    ))

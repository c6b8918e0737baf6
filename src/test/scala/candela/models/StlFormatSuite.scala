package candela.models

import candela.models.MeshFormats.*
import candela.scenefile.SceneDescription

import java.nio.{ByteBuffer, ByteOrder}

import org.scalatest.funsuite.AnyFunSuite

class StlFormatSuite extends AnyFunSuite:
  private val corners = Vector(
    Vector(0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f, 0f),
    Vector(1f, 0f, 0f, 1f, 1f, 0f, -0f, 1f, 0f)
  )

  private def binary(
      header: String = "",
      claimed: Int = 2,
      attributes: Vector[Int] = Vector(0, 0),
      triangles: Vector[Vector[Float]] = corners,
      tail: Int = 0
  ): Array[Byte] =
    val out = ByteBuffer.allocate(84 + 50 * triangles.size + tail).order(ByteOrder.LITTLE_ENDIAN)
    out.put(header.getBytes("ISO-8859-1")).position(80).putInt(claimed): Unit
    for (t, a) <- triangles.zip(attributes) do
      for _ <- 0 until 3 do out.putFloat(0f)
      t.foreach(out.putFloat)
      out.putShort(a.toShort)
    out.array

  private val text = "solid a b\n" + corners.map { t =>
    t.grouped(3).map(_.mkString(" vertex ", " ", "\n"))
      .mkString("facet normal 0 0 0\n outer loop\n", "", " endloop\nendfacet\n")
  }.mkString + "endsolid a b\n"

  private def model(content: Array[Byte]): SceneDescription = read(Seq("m.stl" -> content))

  private def points(s: SceneDescription) =
    val p = floats(s.shapes.head.shape, "P").grouped(3).toVector
    ints(s.shapes.head.shape, "indices").map(p)

  test("text and binary are the same mesh, whose equal vertices are one"):
    val expected = corners.flatMap(_.map(_ + 0f).grouped(3))
    val long = "solid" + text.drop(5).replace("\n", "\r\n").toUpperCase
    val oneLine = text.replaceFirst("\n", "\r").replaceAll("\n *", " ").replace("\r", "\n")
      .replace("facet normal 0 0 0", "facet normal -nan(ind) 0 0")
    for content <-
        Vector(
          bytes(text), bytes(long), bytes(oneLine), binary(), binary("solid part"), binary(tail = 7)
        )
    do
      val scene = model(content)
      assert(scene.errors.isEmpty && points(scene) == expected)
      assert(floats(scene.shapes.head.shape, "P").size == 12)
      assert(scene.additions.get.contains("z points up"))

  test("colours are those of VisCAM, or of Materialise if the header says so"):
    def first(content: Array[Byte]) = floats(model(content).shapes.head.shape, "colors")
    val red = 31 << 10
    val viscam = first(binary(attributes = Vector(red | 0x8000, 0)))
    assert(viscam.take(4) == Vector(1f, 0f, 0f, 1f) && viscam(12) == 0.8f)
    val header = "COLOR=" + "\u0000\u00ff\u0000\u00ff"
    val materialise = first(binary(header, attributes = Vector(31, 0x8000)))
    assert(materialise.take(3) == Vector(1f, 0f, 0f))
    assert(materialise.slice(12, 15) == Vector(0f, 1f, 0f))

  test("damaged files are errors with a place"):
    assert(error(model(binary(claimed = 3))) ==
      "m.stl:0:0: the file is too short for its 3 triangles: 100 bytes follow the header")
    assert(error(model(binary(claimed = -1))).contains("too short for its 4294967295 triangles"))
    assert(error(model(Array[Byte](1, 2, 3))).contains("expected an STL file"))
    val infinite = corners.updated(1, Vector.fill(9)(Float.NaN))
    assert(error(model(binary(triangles = infinite))).contains("NaN NaN NaN in triangle 2"))
    assert(error(model(bytes("solid a\nfacet\nvertex 0 0 x\n"))) ==
      "m.stl:3:12: expected a number, found `x`")
    assert(error(model(bytes("solid a\nfacet\nvertex 0 0 0\nendfacet\n"))) ==
      "m.stl:4:9: expected a facet of three vertices, found 1")
    assert(error(model(bytes("solid a\nfacet\n"))).contains("ends within a facet"))
    assert(error(model(bytes("solid a\nendsolid a\n"))).contains("the model has no surface"))
    assert(error(model(bytes("solid a\nvertices\n"))).contains("found `vertices`"))

package candela.mitsuba

import candela.io.InputFile
import candela.build.shapes.PlyFile
import candela.math.*

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class MeshAttributesSuite extends AnyFunSuite:
  private val quilt = Path.of("scenes/mitsuba/quilt.ply")
  private val ply = PlyFile.read(InputFile.named(quilt), keepsAll = true)
  private val attributes = MeshAttributes(ply)

  /** The value of a channel at u and v of the grid. */
  private def at(name: String, c: Int)(u: Float, v: Float): Float =
    val (channels, values) = attributes.grid(name).get
    val own = Array.tabulate(values.length / channels)(i => values(i * channels + c))
    val grid = TrilinearGrid(attributes.width, attributes.height, 1, own, GridEdge.Clamped)
    grid(u, v, 0.5f)

  test("numbers of vertices and faces are kept if asked for, those of quads twice"):
    assert(PlyFile.read(InputFile.named(quilt)).ofVertices.isEmpty)
    assert(ply.ofVertices.map(_._1) == Vector("r", "g", "b"))
    assert(ply.ofTriangles.map(_._1) == Vector("shine_0"))
    assert(ply.ofTriangles.head._2.length == ply.indices.length / 3)
    val file = Files.createTempFile("candela", ".ply")
    try
      val text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" +
        "property float z\nelement face 2\nproperty float dirt_0\n" +
        "property list uchar int vertex_indices\nend_header\n" +
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n7 4 0 1 2 3\n8 3 0 1 2\n"
      val quad = PlyFile.read(InputFile.named(Files.writeString(file, text)), keepsAll = true)
      assert(quad.ofTriangles.map((name, v) => name -> v.toSeq) ==
        Vector("dirt_0" -> Seq(7f, 7f, 8f)))
    finally Files.delete(file)

  test("vertex numbers are linear over each triangle, those of faces constant"):
    val positions = ply.positions
    val mesh = attributes.laidOut(Mesh(positions, ply.normals, ply.uvs, ply.indices))
    for t <- 0 until ply.indices.length / 3; (a, b) <- Seq((0f, 0f), (1f, 0f), (0.2f, 0.5f)) do
      val w = Seq(1f - a - b, a, b)
      def mean(of: Int => Float) = w.indices.map(k => w(k) * of(3 * t + k)).sum
      val (u, v) = (mean(i => mesh.uvs(2 * i)), mean(i => mesh.uvs(2 * i + 1)))
      val red = mean(i => ply.ofVertices.head._2(ply.indices(i)))
      assert(Math.abs(at("vertex_color", 0)(u, v) - red) < 1e-5f)
      assert(Math.abs(at("face_shine", 0)(u, v) - ply.ofTriangles.head._2(t)) < 1e-5f)
      assert(mean(i => mesh.positions(3 * i)) == mean(i => positions(3 * ply.indices(i))))

  test("attributes are named by their prefix, colours without one"):
    val value = Array(0f)
    def names(properties: String*) =
      MeshAttributes.grouped("vertex", properties.map(_ -> value).toVector)
        .map((name, channels) => (name, channels.size))
    assert(names("r", "g", "b") == Vector(("vertex_color", 3)))
    assert(names("red", "green", "blue", "alpha") == Vector(("vertex_color", 4)))
    assert(names("old_paint_r", "old_paint_g", "old_paint_b") ==
      Vector(("vertex_old_paint_color", 3)))
    assert(names("heat_1", "wind_x", "wind_y", "quality") ==
      Vector(("vertex_heat", 1), ("vertex_wind", 2)))
    assert(attributes.grid("vertex_colour").isEmpty)

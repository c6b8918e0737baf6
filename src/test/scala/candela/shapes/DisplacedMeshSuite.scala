package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import java.nio.file.Path

final class DisplacedMeshSuite extends AnyFunSuite:

  /** The unit square as two triangles, which wind counter-clockwise around z. */
  private val corners = Array(0f, 0f, 0f, 1f, 0f, 0f, 1f, 1f, 0f, 0f, 1f, 0f)
  private val uvs = Array(0f, 0f, 1f, 0f, 1f, 1f, 0f, 1f)
  private val halves = Array(0, 1, 2, 0, 2, 3)

  private def displaced(
      longest: Float,
      toWorld: Transform = Transform.Identity,
      normals: Array[Float] = Array.empty
  )(height: (Vec3, Float, Float) => Float): DisplacedMesh =
    DisplacedMesh.of(corners, normals, uvs, halves, toWorld, longest)(height)

  private def point(mesh: DisplacedMesh, i: Int) =
    Vec3(mesh.positions(3 * i), mesh.positions(3 * i + 1), mesh.positions(3 * i + 2))

  private def edges(mesh: DisplacedMesh): Vector[(Int, Int)] =
    mesh.indices.grouped(3).toVector.flatMap(t => Vector(t(0) -> t(1), t(1) -> t(2), t(2) -> t(0)))

  test("all edges get shorter than asked, and triangles that share one split it alike"):
    val mesh = displaced(0.2f)((_, _, _) => 0f)
    for (a, b) <- edges(mesh) do assert((point(mesh, a) - point(mesh, b)).length < 0.2f)
    // Each inner edge is walked once in each direction; those of the border in one
    val all = edges(mesh)
    val alone = all.filterNot((a, b) => all.contains((b, a)))
    for (a, b) <- alone do
      val middle = (point(mesh, a) + point(mesh, b)) * 0.5f
      assert(Seq(middle.x, middle.y).exists(v => v == 0f || v == 1f), middle)
    assert(all.distinct.size == all.size)

  test("edges are as long as they are in world space"):
    val small = displaced(0.2f)((_, _, _) => 0f).indices.length
    val scaled = displaced(0.4f, Transform.scale(2f, 2f, 2f).get)((_, _, _) => 0f).indices.length
    assert(scaled == small)

  test("edges that are short enough stay, and vertices move along the normal by the height"):
    val mesh = displaced(9f)((p, u, v) => u + 2f * v + 4f * p.x)
    assert(mesh.indices.sameElements(halves))
    val heights = (0 until 4).map(point(mesh, _).z)
    assert(heights == Vector(0f, 5f, 7f, 2f))

  test("given normals say where to, and those of the result are of the moved faces"):
    val sideways = Array.fill(4)(Array(0f, 0.6f, 0.8f)).flatten
    val mesh = displaced(9f, normals = sideways)((_, _, _) => 10f)
    assert(point(mesh, 0) == Vec3(0f, 6f, 8f))
    val sloped = displaced(0.3f)((p, _, _) => p.x)
    for i <- 0 until sloped.positions.length / 3 do
      val n = Vec3(sloped.normals(3 * i), sloped.normals(3 * i + 1), sloped.normals(3 * i + 2))
      assert((n - Vec3(-1f, 0f, 1f).normalized).length < 1e-5f) // rounding

  test("an edge length below the spacing of numbers ends"):
    val mesh = DisplacedMesh.of(
      Array(1e6f, 0f, 0f, 1e6f + 1f, 0f, 0f, 1e6f, 0.5f, 0f),
      Array.empty,
      uvs.take(6),
      Array(0, 1, 2),
      Transform.Identity,
      longest = 0.05f
    )((_, _, _) => 0f)
    assert(mesh.indices.length > 30)

  test("a tiny edge length is refused before triangles are split"):
    val e = intercept[MeshError]:
      DisplacedMesh.of(
        Array(0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f, 0f),
        Array.empty,
        uvs.take(6),
        Array(0, 1, 2),
        Transform.Identity,
        longest = 1e-38f
      )((_, _, _) => fail("a vertex was made"))
    assert(e.getMessage.contains("makes more than"))

  private def plan(mesh: String, settings: RenderSettings = RenderSettings()): String =
    val text =
      s"""Film "rgb" "integer xresolution" 8 "integer yresolution" 8
         |WorldBegin
         |LightSource "infinite"
         |Texture "h" "float" "constant" "float value" .1
         |Scale 2 2 2
         |Shape "plymesh" $mesh "texture displacement" "h"
         |""".stripMargin
    val description = SceneTexts.parse(text, Dialect.V4, Path.of("scenes"))
    val made = candela.build.SceneBuilder.build(description, settings)._1
    made.features.toMap.apply("triangles")

  private val sheet = """"string filename" "geometry/sheet-quads.ply""""

  test("a mesh of quads is displaced as triangles, of an edge length that can be scaled"):
    // Squares of side 6 in world space: two triangles each, or half of one
    assert(plan(s"$sheet \"float edgelength\" 99") == "8")
    val fine = plan(s"$sheet \"float edgelength\" 2").toInt
    val scaled = plan(s"$sheet \"float edgelength\" 1", RenderSettings(edgeScale = Some(2f))).toInt
    assert(fine > 8 && scaled == fine)

  test("a mesh without uv, or an edge length of 0, is an error"):
    def errors(mesh: String) =
      val text = s"WorldBegin\nTexture \"h\" \"float\" \"constant\"\nShape \"plymesh\" $mesh " +
        "\"texture displacement\" \"h\""
      SceneTexts.problems(text, Dialect.V4, Path.of("scenes")).map(_.message).mkString
    assert(errors(s"$sheet \"float edgelength\" 0").contains("must be above 0"))
    val cube = """"string filename" "geometry/cube-ascii.ply""""
    assert(errors(cube).contains("needs texture coordinates"))

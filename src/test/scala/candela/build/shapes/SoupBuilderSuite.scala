package candela.build.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.math.Transform
import candela.shapes.{BumpTangents, TriangleSoup}

class SoupBuilderSuite extends AnyFunSuite:
  private val square = Array[Float](0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
  private val halves = Array(0, 1, 2, 0, 2, 3)

  private def soup(uvs: Array[Float]*): TriangleSoup =
    val builder = SoupBuilder()
    for uv <- uvs do
      val mesh = new ShapeGeometry.Triangles(square, Array.empty, uv, halves)
      builder.add(
        mesh,
        Transform.Identity,
        reversed = false,
        flipNormals = true,
        isTurned = false,
        material = 0,
        firstLight = -1,
        BumpTangents.Along
      ): Unit
    builder.result(tangents = true, relief = true)

  test("the triangles of a mesh have its own vertices"):
    val none = Array.emptyFloatArray
    val two = soup(none, none)
    assert(two.indices.slice(0, two.indices.length).toSeq == halves.toSeq ++ halves.map(_ + 4))
    assert(two.positions.toSeq == square.toSeq ++ square && two.meshes(1).firstVertex == 4)

  test("uv that are the same at all vertices are kept once, to the bit"):
    def kept(uvs: Float*) = soup(uvs.toArray).meshes(0).uvs.toSeq
    val same = Seq.fill(4)(Seq(0.25f, 0.5f)).flatten
    assert(kept(same*) == Seq(0.25f, 0.5f))
    assert(kept() == Seq())
    for i <- 2 until 8 do
      val other = same.updated(i, 0.75f)
      assert(kept(other*) == other)
    val zeros = Seq.fill(7)(0f) :+ -0f
    assert(kept(zeros*).length == 8)

package candela.models.assimp

import candela.image.Natives
import candela.io.SceneFolder
import candela.models.Session

import org.lwjgl.assimp.Assimp
import org.lwjgl.system.MemoryUtil
import org.scalatest.funsuite.AnyFunSuite

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.Path

class AssimpMeshesSuite extends AnyFunSuite:

  /** A square of four triangles around its middle, which a morph target makes the apex of a pyramid
    * without normals of its own.
    */
  private def pyramid: String =
    def row(each: String) = Vector.fill(5)(each).mkString(",")
    val normals = s"""LayerElementNormal: 0 {
      |  MappingInformationType: "ByVertice"
      |  ReferenceInformationType: "Direct"
      |  Normals: *15 { a: ${row("0,0,1")} }
      |}
      |LayerElementUV: 0""".stripMargin
    val target = s"""Geometry: 10, "Geometry::raised", "Shape" { Version: 100
      |  Indexes: *5 { a: 0,1,2,3,4 }
      |  Vertices: *15 { a: 0,0,100,${row("0,0,0").drop(6)} }
      |  Normals: *15 { a: ${row("0,0,0")} }
      |}
      |Deformer: 11, "Deformer::d", "BlendShape" { Version: 100 }
      |Deformer: 12, "SubDeformer::raised", "BlendShapeChannel" { Version: 100
      |  DeformPercent: 0
      |  FullWeights: *1 { a: 100 }
      |}""".stripMargin
    AssimpFiles.fbx("", lights = (target, AssimpFiles.morphed._2))
      .replace(
        "*9 { a: 0,0,0,100,0,0,0,0,100 }",
        "*15 { a: 0,0,0,100,100,0,-100,100,0,-100,-100,0,100,-100,0 }"
      )
      .replace("*3 { a: 0,1,-3 }", "*12 { a: 0,1,-3,0,2,-4,0,3,-5,0,4,-2 }")
      .replace("UV: *6 { a: 0,0,1,0,0,1 }", s"UV: *10 { a: ${row("0,0")} }")
      .replace("LayerElementUV: 0", normals)
      .replace(
        "LayerElement:  { Type: \"LayerElementUV\"",
        "LayerElement:  { Type: \"LayerElementNormal\" TypedIndex: 0 }\n" +
          "LayerElement:  { Type: \"LayerElementUV\""
      )

  test("morph targets of FBX without normals turn these as the moved faces do"):
    try Natives.require("assimp", "assimp")
    catch case e: LinkageError => cancel(s"skipped: ${e.getMessage}")
    val text = pyramid.getBytes(UTF_8)
    val buffer = MemoryUtil.memAlloc(text.length).put(text).flip()
    val steps = Assimp.aiProcess_JoinIdenticalVertices
    val scene = Assimp.aiImportFileFromMemory(buffer, steps, "fbx")
    assert(scene != null, Assimp.aiGetErrorString)
    try
      val arrays = Arrays()
      val session = Session(Path.of("a.fbx"), SceneFolder.Nowhere, keepGoing = false)
      val meshes = AssimpMeshes(scene, session, "fbx", arrays)
      assert(meshes.of(Vector(0)).contains(0))
      val primitive = meshes.entries.head("primitives")(0)
      def vectors(accessor: ujson.Value) =
        val floats = arrays.buffer(accessor.num.toInt).duplicate
          .order(java.nio.ByteOrder.LITTLE_ENDIAN).asFloatBuffer
        Vector.fill(floats.remaining)(floats.get.toDouble).grouped(3).toVector
      val turns = vectors(primitive("targets")(0)("NORMAL"))
      val positions = vectors(primitive("attributes")("POSITION"))
      assert(turns.size == positions.size && positions.distinct.size == 5)
      // Where two faces of 45° meet alike: (±1, ±1, 2) / √6
      for (p, turn) <- positions.zip(turns) do
        val sides = p.map(Math.signum)
        val raised = sides.updated(2, if sides(0) == 0 then 1.0 else 2.0)
        val length = Math.sqrt(raised.map(x => x * x).sum)
        val expected = raised.map(_ / length).zip(Vector(0.0, 0.0, 1.0)).map(_ - _)
        for (x, y) <- turn.zip(expected) do assert(Math.abs(x - y) < 1e-6, s"$p: $turn")
    finally
      Assimp.aiReleaseImport(scene)
      MemoryUtil.memFree(buffer)

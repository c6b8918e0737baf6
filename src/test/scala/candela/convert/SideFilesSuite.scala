package candela.convert

import candela.diagnostics.SceneError
import java.nio.file.Files

import candela.scenefile.{Dialect, Parser}
import candela.testing.TempFolder
import org.scalatest.funsuite.AnyFunSuite

class SideFilesSuite extends AnyFunSuite:

  test("a file is named by what is in it, written once, and never in place of another"):
    TempFolder.use: folder =>
      val files = SideFiles(folder)
      val name = files.add("mesh", "ply", Array[Byte](1, 2, 3))
      assert(files.add("mesh", "ply", Array[Byte](1, 2, 3)) == name)
      assert(files.add("mesh", "ply", Array[Byte](1, 2, 4)) != name)
      assert(TempFolder.names(folder).size == 2)
      val _ = Files.write(folder.resolve(name), Array[Byte](9))
      val error = intercept[SceneError](files.add("mesh", "ply", Array[Byte](1, 2, 3)))
      assert(error.getMessage.contains("exists with different content"))

  test("large meshes go into PLY files that hold the same numbers"):
    TempFolder.use: folder =>
      val text = """WorldBegin
          |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] 
          |  "normal N" [0 0 1 0 0 1 0 0 1 0 .1 1] "point P" [0 0 0 1 0 0 1 1 0 0 1 .3]
          |  "float uv" [0 0 1 0 1 1 0 .7] "float alpha" 0
          |Shape "trianglemesh" "integer indices" [0 1 2] "point P" [0 0 0 1 0 0 1 1 0]
          |WorldEnd""".stripMargin
      val scene = Parser.parseText("test.pbrt", text, folder, Some(Dialect.V3))
      val shapes = Converter.convert(scene, Dialect.V3, folder, Some(2)).scene.shapes.map(_.shape)
      assert(shapes.map(_.name) == Vector("plymesh", "trianglemesh"))
      assert(shapes.head.params.map(_.name) == Vector("filename", "alpha"))
      val file = folder.resolve(shapes.head.param("filename").get.strings.head)
      val mesh = candela.build.shapes.PlyFile.read(candela.io.InputFile.named(file))
      assert(mesh.positions.sameElements(scene.shapes.head.shape.param("P").get.floats))
      assert(mesh.normals.sameElements(scene.shapes.head.shape.param("N").get.floats))
      assert(mesh.uvs.sameElements(scene.shapes.head.shape.param("uv").get.floats))
      assert(mesh.indices.toVector == Vector(0, 1, 2, 0, 2, 3))

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

  test("names of missing files stay, and each is a warning"):
    TempFolder.use: folder =>
      def converted(world: String, from: Dialect, to: Dialect) =
        val end = if from == Dialect.V4 then "" else "\nWorldEnd"
        val text = s"WorldBegin\n$world$end"
        Converter.convert(Parser.parseText("t.pbrt", text, folder, Some(from)), to, folder)
      val light = "LightSource \"infinite\" \"rgb L\" [.2 .3 1] \"string "
      val texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\""
      for
        (from, to) <- Vector(Dialect.V3 -> Dialect.V4, Dialect.V4 -> Dialect.V3)
        (name, renamed) =
          if to == Dialect.V4 then "mapname" -> "filename" else "filename" -> "mapname"
      do
        val made = converted(s"$light$name\" \"no.exr\"\n$texture", from, to)
        val messages = made.warnings.map(_.message)
        val (file, side) =
          (messages.filter(_.contains("no.exr")), messages.filter(_.contains("no.png")))
        assert(file.size == 1 && side.size == 1, messages)
        assert(file.head.contains("leaving it unchanged"))
        assert(file.head.contains("without the colour") == (to == Dialect.V4))
        val declared = made.scene.lights.head.light
        assert(declared.param(renamed).get.strings == Vector("no.exr"))
        assert(made.scene.textures.head.texture.param("filename").get.strings == Vector("no.png"))

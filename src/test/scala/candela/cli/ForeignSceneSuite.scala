package candela.cli

import candela.cli.terminal.ExitCode
import candela.image.{Image, ImageFiles}
import candela.testing.{Gzip, TempFolder}

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** Files that are no scenes, where scenes are expected. */
class ForeignSceneSuite extends AnyFunSuite:

  private val commands = Vector("render", "check", "convert", "preview")

  test("one name for the images of a turntable is refused"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
      val (code, captured) = Captured.run(s"$file", "--turntable", "2", "--outfile", "b.png")
      assert(code == ExitCode.BadInput.number)
      assert(captured.err.contains("has several images; `b.png` names one"), captured.err)

  private def refusal(words: String*): Vector[String] =
    val (code, captured) = Captured.run(words*)
    assert(code == ExitCode.BadInput.number && captured.out.isEmpty)
    captured.err.linesIterator.toVector

  test("an image in place of a scene is named, with the command that shows it"):
    TempFolder.use: folder =>
      val image = Image.rgb(4, 4)
      for (name, what) <- Vector("a.exr" -> "an OpenEXR image", "a.png" -> "a PNG image") do
        val file = s"$folder/$name"
        ImageFiles.write(Path.of(file), image)
        for command <- commands do
          assert(refusal(command, file) == Vector(
            s"error: `$file` is $what, not a scene [E0102]",
            s" `candela view $file` shows it"
          ))

  test("a Mitsuba scene by another suffix is no scene of pbrt"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.pbrt"), "<scene version=\"3.0.0\"></scene>")
      assert(refusal("check", s"$file") == Vector(
        s"error: `$file` is a Mitsuba scene, not a pbrt scene [E0102]",
        " its name must end with .xml"
      ))

  test("meshes and models in place of scenes are named, also if packed or by a wrong suffix"):
    TempFolder.use: folder =>
      val ply = "ply\nformat ascii 1.0\nend_header\n".getBytes
      for (name, bytes) <- Vector("a.pbrt.gz" -> Gzip.of(ply), "b.pbrt" -> ply) do
        val file = Files.write(folder.resolve(name), bytes)
        val what = s"`$file` is a PLY mesh, not a scene"
        assert(refusal("check", s"$file").head == s"error: $what [E0102]")
      val model = Files.writeString(folder.resolve("a.json"), "{\"asset\": {}}")
      val lines = refusal(s"$model")
      assert(lines(0).endsWith("is a glTF model, not a scene [E0102]"))
      assert(lines(1).contains("export it"))
      val mitsuba = Files.writeString(folder.resolve("m.pbrt"), "<scene version=\"3.0.0\"></scene>")
      assert(refusal(s"$mitsuba")(1) == " its name must end with .xml")

  private val formats =
    "pbrt (.pbrt), Mitsuba (.xml), glTF (.glb, .gltf), OBJ (.obj), PLY (.ply), STL (.stl) or " +
      "Assimp (.fbx, .dae, .3ds and others)"

  test("a model in place of a scene is told the formats that scenes have"):
    TempFolder.use: folder =>
      val model = Files.writeString(folder.resolve("model.blend"), "BLENDER-v300")
      for command <- commands do
        val lines = refusal(command, s"$model")
        assert(lines(0) == s"error: `$model` is a Blender file, not a scene [E0102]")
        assert(
          lines(1).contains(s"a scene of $formats"),
          lines(1)
        )

  test("a text by another name is a scene if it begins as one"):
    TempFolder.use: folder =>
      val notes = Files.writeString(folder.resolve("notes.txt"), "# mine\nto do: lights\n")
      for command <- commands do
        assert(refusal(command, s"$notes") == Vector(
          s"error: `$notes` is not a scene: its first word is not a pbrt directive [E0102]",
          s" supported scene formats: $formats"
        ))
      val scene = "# mine\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
      val file = Files.writeString(folder.resolve("scene.txt"), scene)
      assert(Captured.run("check", s"$file")._1 == 0)
      val misnamed = Files.writeString(folder.resolve("scene.xml"), scene)
      assert(refusal("check", s"$misnamed") == Vector(
        s"error: `$misnamed` is a pbrt scene, not a Mitsuba scene [E0102]",
        " its name must end with .pbrt"
      ))
      val mistyped = Files.writeString(folder.resolve("b.txt"), scene.replace("Camera", "Camra"))
      assert(refusal("check", s"$mistyped").head.startsWith(s"$mistyped:2:1: error: unknown"))
      val ours = Files.writeString(folder.resolve("c.pbrt"), "to do: lights\n")
      assert(refusal("check", s"$ours").head.startsWith(s"$ours:1:1: error: unknown"))

  test("a packed scene is a scene"):
    TempFolder.use: folder =>
      val scene = "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
      val file = Files.write(folder.resolve("a.pbrt.gz"), Gzip.of(scene.getBytes))
      assert(Captured.run("check", s"$file")._1 == 0)

  test("a saved rendering in place of a scene is named, and info tells of it"):
    TempFolder.use: folder =>
      val text = "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 3\n" +
        "Sampler \"random\" \"integer pixelsamples\" 4\n" +
        "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
      val scene = Files.writeString(folder.resolve("a.pbrt"), text)
      val film = s"$folder/a.film"
      assert(Captured.run(s"$scene", "-o", film, "--seed", "7", "--quiet")._1 == 0)
      for command <- commands do
        val lines = refusal(command, film)
        assert(lines(0) == s"error: `$film` is a saved rendering, not a scene [E0102]")
        assert(lines(1).contains(s"`candela resume $film`") && lines(1).contains("candela info"))
      val (code, captured) = Captured.run("info", film)
      assert(code == 0, captured.err)
      val facts = captured.out.linesIterator.map(_.split(" {2,}", 2)).map(w => w(0) -> w(1)).toMap
      assert(facts("scene") == s"$scene" && facts("samples") == "4 of 4 per pixel: complete")
      val part = s"$folder/part.film"
      val words = Vector("--spp", "16", "--shard", "0/2", "--outfile", part)
      assert(Captured.run(scene.toString +: words*)._1 == 0)
      val of = Captured.run("info", part)._2.out.linesIterator.toVector
      assert(of.exists(_.endsWith("8 of 16 per pixel")), of)
      assert(of.exists(_.endsWith("0/2: complete")), of)
      assert(facts("size").startsWith("2x3") && facts("options") == "--seed 7")

  test("an included file that is no scene is named where it is included"):
    TempFolder.use: folder =>
      ImageFiles.write(folder.resolve("a.exr"), Image.rgb(4, 4))
      val scene = Files.writeString(folder.resolve("a.pbrt"), "WorldBegin\nInclude \"a.exr\"\n")
      val lines = refusal("check", s"$scene")
      assert(lines.head ==
        s"$scene:2:9: error: can't include `a.exr`: it is an OpenEXR image, not a scene [E0102]")

  test("a scene in place of an image is named"):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("a.pbrt"), "WorldBegin\n")
      for command <- Vector("view", "info") do
        assert(refusal(command, s"$scene").head.startsWith(s"error: $scene: it is a scene"))

package candela.cli.commands

import candela.cli.Captured
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class ConvertCommandSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("convert" +: args*)

  private val old =
    "WorldBegin\nMaterial \"matte\" \"float sigma\" 20\nShape \"sphere\"\nWorldEnd\n"

  private def scene(folder: Path): Path = Files.writeString(folder.resolve("a.pbrt"), old)

  test("without --outfile the scene is printed, and what is lost is said with its place"):
    TempFolder.use: folder =>
      val file = scene(folder)
      val (code, captured) = run(file.toString, "--to", "v4", "--dialect", "v3")
      assert(code == 0)
      assert(captured.out.contains("Material \"diffuse\""))
      val lost = "`sigma` of \"matte\" is not supported in v4; Lambertian"
      assert(captured.err.contains(s"$file:2:18: warning: $lost [E0901]\n 2 | Material"))
      assert(TempFolder.names(folder) == Set("a.pbrt"))

  test("with --outfile it is written, and one line says so"):
    TempFolder.use: folder =>
      val out = folder.resolve("b.pbrt")
      val (code, captured) =
        run(scene(folder).toString, "--to", "v4", "--dialect", "v3", "--outfile", out.toString)
      assert(code == 0)
      assert(captured.out == s"wrote $out  v4, 1 warning\n")
      assert(Files.readString(out).contains("Film \"rgb\""))
      assert(TempFolder.names(folder) == Set("a.pbrt", "b.pbrt"))

  test("the last line counts the warnings of reading, too"):
    TempFolder.use: folder =>
      val sensors = "<sensor type=\"perspective\"/>" * 2
      val text = s"<scene version=\"3.0.0\">$sensors</scene>"
      val file = Files.writeString(folder.resolve("a.xml"), text).toString
      val (code, captured) = run(file, "--outfile", folder.resolve("b.pbrt").toString)
      val warnings = captured.err.linesIterator.count(_.contains(": warning: "))
      assert(code == 0 && warnings > 0 && captured.err.contains("--sensor"), captured.err)
      assert(captured.out.contains(s", $warnings warning"), captured.out + captured.err)

  test("a name of another format is an error before anything is written"):
    TempFolder.use: folder =>
      val out = folder.resolve("b.xml")
      val (code, captured) = run(scene(folder).toString, "--to", "v4", "--outfile", out.toString)
      assert(code == 1 && captured.err.contains("is the name of a file of Mitsuba"), captured.err)
      assert(TempFolder.names(folder) == Set("a.pbrt"))

  test("an image, a film and a model are not replaced by text"):
    TempFolder.use: folder =>
      val input = scene(folder).toString
      for
        (name, kind) <- Vector(
          "p.exr" -> "an image",
          "p.JPG" -> "an image",
          "p.hdr" -> "an image",
          "p.film" -> "a film file",
          "p.glb" -> "a file of glTF"
        )
      do
        val file = Files.writeString(folder.resolve(name), "kept")
        val (code, captured) = run(input, "--outfile", file.toString)
        val refusal = s"error: `$file` is the name of $kind; convert writes scenes of pbrt [E0106]"
        assert(code == 1 && captured.err.startsWith(s"$refusal\n name it .pbrt"), captured.err)
        assert(Files.readString(file) == "kept")

  test("a missing include is an error, without the advice to use an option that convert lacks"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.pbrt"), "Include \"none.pbrt\"\n")
      val (code, captured) = run(file.toString, "--to", "v4")
      assert(code == 1 && captured.err.contains("can't include `none.pbrt`"))
      assert(!captured.err.contains("--keep-going"))
      assert(run(file.toString, "--to", "v4", "--keep-going")(0) == 2)

  test("what is read is not overwritten, nor is a folder"):
    TempFolder.use: folder =>
      val file = scene(folder)
      val (code, captured) = run(file.toString, "--to", "v3", "--outfile", s"$folder/./a.pbrt")
      assert(code == 1 && captured.err.contains("is an input file"))
      assert(Files.readString(file) == old)
      val (other, said) = run(file.toString, "--to", "v3", "--outfile", folder.toString)
      assert(other == 1 && said.err.contains("it is a folder"))

  test("without a dialect to write it is the scene's own, and v2 is written from v2 alone"):
    TempFolder.use: folder =>
      val file = scene(folder).toString
      val (own, printed) = run(file)
      assert(own == 0 && printed.out.contains("WorldEnd")) // as in v2 and v3
      val (code, captured) = run(file, "--to", "v2", "--dialect", "v3")
      assert(code == 1 && captured.err.contains("can't convert a v3 scene to v2"))
      val model = "scenes/models/gl-shapes.gltf"
      val (refused, why) = run(model, "--to", "v2", "--outfile", s"$folder/shapes.pbrt")
      assert(refused == 1 && why.err.contains("can't convert a gltf scene to v2"))

package candela.cli

import candela.image.ImageFiles

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class PreviewCommandSuite extends AnyFunSuite:

  private val scene = """Film "image" "integer xresolution" 12 "integer yresolution" 8
    LookAt 0 0 -4  0 0 0  0 1 0
    Camera "perspective"
    Integrator "bdpt" WorldBegin
    Texture "t" "color" "imagemap" "string filename" "missing.png"
    Material "matte" "texture Kd" "t"
    Shape "sphere" """

  test("a scene with missing files is shown, and the placeholders are named"):
    TempFolder.use: folder =>
      val file = folder.resolve("s.pbrt")
      Files.writeString(file, scene)
      val captured = Captured()
      val out = folder.resolve("look.png")
      val words = Seq("preview", file.toString, "--outfile", out.toString, "--thumbnail", "blocks")
      assert(Main.run(words, captured.terminal) == 0)
      val image = ImageFiles.read(out).linear
      assert((image.width, image.height) == (12, 8))
      // Magenta stands for a missing picture.
      assert(image(6, 4, 0) > 0.4f && image(6, 4, 1) < 0.01f && image(6, 4, 2) > 0.4f)
      assert(captured.err.contains("missing.png") && captured.out.contains("1 placeholder"))
      assert(captured.out.count(_ == '▀') == 12 * 4)

  test("warnings about what a first look ignores are for --verbose"):
    TempFolder.use: folder =>
      val file = folder.resolve("s.pbrt")
      val glass = "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\""
      Files.writeString(file, s"Integrator \"path\" WorldBegin $glass Shape \"sphere\"")
      def run(options: String*) =
        val captured = Captured()
        val words = Seq("preview", file.toString, "--outfile", s"$folder/a.png") ++ options
        assert(Main.run(words, captured.terminal) == 0)
        captured.err
      assert(run() == "")
      assert(run("--verbose").contains("dispersion of \"dielectric\" needs"))

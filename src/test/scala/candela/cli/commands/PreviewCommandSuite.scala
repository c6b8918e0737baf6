package candela.cli.commands

import candela.cli.{Captured, Main}
import candela.color.Rgb
import candela.image.ImageFiles
import candela.job.{Prepared, SceneLoader}
import candela.render.TinyPlan
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

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
      // Small: a busy machine may not end a larger one's first pass in time
      val film = "Film \"rgb\" \"integer xresolution\" 12 \"integer yresolution\" 8"
      Files.writeString(file, s"$film Integrator \"path\" WorldBegin $glass Shape \"sphere\"")
      def run(options: String*) =
        val captured = Captured()
        val words = Seq("preview", file.toString, "--outfile", s"$folder/a.png") ++ options
        assert(Main.run(words, captured.terminal) == 0)
        captured.err
      assert(run() == "")
      assert(run("--verbose").contains("dispersion of \"dielectric\" needs"))

  test("discarded samples are told, without options that preview does not have"):
    TempFolder.use: folder =>
      object Sick extends SceneLoader:
        private val plan = TinyPlan(): (where, _) =>
          if where.x == 3 && where.sample == 2 then Rgb(Float.NaN, 0f, 0f) else Rgb.White
        def load(scene: String, settings: RenderSettings, control: BuildControl): Prepared =
          Prepared(SceneDescription(Dialect.V4), plan, Vector.empty, 0.5, 0.25)
      val captured = Captured()
      val words = Seq("preview", "s.pbrt", "--outfile", s"$folder/a.png")
      assert(Main.run(words, captured.terminal, Sick) == 0)
      val where = "the first at pixel (3, 0), sample 2 [E1105]"
      assert(captured.err.endsWith(s"samples discarded: NaN or infinite, $where\n"), captured.err)

package candela.cli

import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tags.Slow

/** What goes wrong is printed, however quiet a command is to be. */
@Slow
class QuietErrorsSuite extends AnyFunSuite:

  test("every command with --quiet prints why it fails"):
    TempFolder.use: folder =>
      def file(name: String) = folder.resolve(name).toString
      val scene = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" +
        "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n"
      Files.writeString(folder.resolve("s.pbrt"), scene): Unit
      ImageFiles.write(folder.resolve("i.exr"), Image.rgb(4, 4))
      def render(words: String*) =
        assert(Captured.run(Vector(file("s.pbrt"), "--quiet") ++ words*)._1 == 0)
      for i <- 0 to 1 do render("--shard", s"$i/2", "--outfile", file(s"$i.film"))
      render("--outfile", file("whole.film"))
      val nowhere = file("i.exr/no")
      val commands = Seq(
        Seq("render", file("s.pbrt"), "--outfile", s"$nowhere.exr"),
        Seq("render", file("s.pbrt"), "--outfile", s"$nowhere.film"),
        Seq("render", file("s.pbrt"), "--shard", "1/2", "--outfile", s"$nowhere.film"),
        Seq("render", file("missing.pbrt"), "--outfile", file("o.exr")),
        Seq("preview", file("missing.pbrt")),
        Seq("resume", file("whole.film"), "--spp", "32", "--outfile", s"$nowhere.exr"),
        Seq("resume", file("1.film"), file("missing.film")),
        Seq("merge", file("0.film"), file("1.film"), "--outfile", s"$nowhere.exr"),
        Seq("merge", file("0.film"), file("1.film"), "--outfile", s"$nowhere.film"),
        Seq("merge", file("1.film"), "--outfile", file("o.exr")),
        Seq("merge", file("1.film"), file("i.exr"), "--outfile", file("o.exr")),
        Seq("render", file("s.pbrt"), "--spark", "nowhere:1", "--outfile", file("o.exr")),
        Seq("reference", file("missing.pbrt"), "--outfile", file("o.exr")),
        Seq("average", file("i.exr"), file("i.exr"), "--outfile", s"$nowhere.exr"),
        Seq("image", file("i.exr"), "--outfile", s"$nowhere.exr"),
        Seq("view", file("i.exr"), "--outfile", s"$nowhere.png"),
        Seq("convert", file("s.pbrt"), "--outfile", s"$nowhere.pbrt"),
        Seq("check", file("missing.pbrt")),
        Seq("compare", file("i.exr"), file("missing.exr"))
      )
      for words <- commands do
        val (code, captured) = Captured.run(words :+ "--quiet"*)
        assert(code != 0 && captured.err.contains("error"), words.mkString(" "))

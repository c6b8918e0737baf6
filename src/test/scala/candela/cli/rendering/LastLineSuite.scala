package candela.cli.rendering

import candela.cli.Captured
import candela.film.{Film, PixelBounds}
import candela.render.Rendering
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** The last line of a rendering tells its error. */
class LastLineSuite extends AnyFunSuite:

  private def said(args: String*): String =
    val (code, said) = Captured.run(args*)
    assert(code == 0, said.err)
    said.out.linesIterator.filter(_.startsWith("wrote ")).toVector.last

  private def scene(folder: Path): String =
    val text =
      """LookAt 0 0 -5  0 0 0  0 1 0
        |Camera "perspective" "float fov" 30
        |Film "rgb" "integer xresolution" 16 "integer yresolution" 16
        |WorldBegin
        |LightSource "infinite"
        |Shape "sphere"
        |""".stripMargin
    Files.writeString(folder.resolve("scene.pbrt"), text).toString

  test("of any number of samples, a continued rendering and one with a goal"):
    TempFolder.use: folder =>
      val file = scene(folder)
      val image = s"$folder/a.exr"
      for samples <- Vector("8", "9", "13", "64", "100") do
        val last = said(file, "--spp", samples, "--outfile", image)
        assert(last.matches(".*, error [0-9.]+ %.*"), last)
      val film = s"$folder/a.film"
      val _ = said(file, "--spp", "6", "--sampler", "sobol", "--outfile", s"$image,$film")
      val resumed = said("resume", film, "--spp", "20")
      assert(resumed.matches(".*, error [0-9.]+ %.*"), resumed)
      val goal = said(file, "--error", "5%", "--outfile", image)
      assert(goal.matches(".*, error [0-9.]+ %.*"), goal)

  test("it names the goal that ended the rendering, if there was one"):
    TempFolder.use: folder =>
      val file = scene(folder)
      val image = s"$folder/a.exr"
      def end(words: String*) = said((file +: words) ++ Seq("--outfile", image)*).split("; ").last
      assert(end("--error", "5%", "--time", "1h") == "ended by --error")
      assert(end("--spp", "8", "--time", "1h") == "ended by --spp")
      assert(!end("--spp", "8").contains("ended"))

  test("a resumed rendering without a new sample says so"):
    def line(earlier: Int) =
      val film = Film(PixelBounds(0, 0, 2, 2))
      val r = Rendering(film, 16, 16, 64, 64, seconds = 1, discarded = None, earlier = earlier)
      Summary.result(Vector(Path.of("a.exr")), r, ending = Some("time"))
    assert(line(16).contains("16 spp (none added), ") && line(16).endsWith("; ended by --time"))
    assert(line(12).contains("16 spp (4 in this run), "))

  test("a resumed shard counts its own samples, of those of all shards"):
    TempFolder.use: folder =>
      val (file, film) = (scene(folder), s"$folder/a.film")
      assert(said(
        file, "--spp", "16", "--sampler", "sobol", "--shard", "1/4", "--outfile", film
      ).contains(", 4 of 16 spp, "))
      val (code, captured) = Captured.run("resume", film, "--spp", "32")
      assert(code == 0 && captured.err.contains(s"continuing $film at 4 of 16 samples per pixel\n"))
      assert(captured.out.contains(", 8 of 32 spp (4 in this run), "), captured.out)

  test("fewer than eight samples say too little"):
    TempFolder.use: folder =>
      for samples <- Vector("1", "4") do
        val last =
          said(scene(folder), "--spp", samples, "--outfile", s"$folder/a.exr")
        assert(last.endsWith("error unknown: too few samples"), last)

package candela.cli.files

import candela.cli.FilmFilesSuite.{Folder, Paths, text}
import candela.cli.options.CommandLine
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

class SequenceSuite extends AnyFunSuite:

  private def inFolder(body: Folder => Any): Any =
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("s.pbrt"), text(Paths, "independent"))
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\" \"float radius\" 3\n")
      body(Folder(folder, scene))

  test("a sequence goes on after a failing scene, and skips what is done on the next run"):
    inFolder: f =>
      for n <- Vector(1, 2, 4) do
        val _ = Files.copy(f.folder.resolve("s.pbrt"), f.folder.resolve(s"s00$n.pbrt"))
      val words = Vector(f("s%03d.pbrt"), "--frames", "1-4", "--outfile", f("out%d.exr"))
      val (code, first) = f.captured(words)
      assert(code == 1)
      assert(first.out.endsWith(s"\n4 scenes: 3 rendered, 1 failed (${f("s003.pbrt")})\n"))
      assert(f.image("out4.exr").width == 24)
      val _ = Files.writeString(f.folder.resolve("s003.pbrt"), text(Paths, "independent"))
      val _ = Files.writeString(f.folder.resolve("s004.pbrt"), text(Paths, "halton"))
      val (again, second) = f.captured(words)
      assert(again == 0, second.err)
      assert(second.out.endsWith("\n4 scenes: 2 rendered, 2 skipped (done already)\n"))
      assert(f.run(words :+ "--spp" :+ "3").endsWith("4 scenes: 4 rendered\n"))

  test("frames of one scene are counted and named by their numbers"):
    inFolder: f =>
      val sized = text(Paths, "independent").replace("xresolution\" 24", "xresolution\" $n")
      val scene = Files.writeString(f.folder.resolve("one.pbrt"), sized).toString
      val words = Vector(scene, "-Dn=%d", "--outfile", f("one%d.exr"), "--frames")
      assert(f.run(words :+ "1-1").contains("one1.exr"))
      val (code, said) = f.captured(words :+ "0-3")
      assert(code == 1, said.err)
      val counts = "2 rendered, 1 skipped (done already), 1 failed"
      assert(said.out.endsWith(s"\n4 scenes: $counts ($scene frame 0)\n"), said.out)

  test("a number takes the place of `%d` where an option chooses among several images"):
    def name(settings: String*): Vector[String] =
      val reading = CommandLine.parse(settings :+ "a.gltf").toOption.get.settings.reading
      Sequence.ofWorld("a.gltf", Vector("x%02d.exr"), reading, 0, isFollowed = false)
    for option <- Vector("--turntable 1", "--at 1", "--at 0:1:0", "--sensor all", "--sensor 0") do
      assert(name(option.split(' ')*) == Vector("x00.exr"), option)
    assert(name("--sensor", "3", "--at", "1") == Vector("x03.exr"))
    assert(name("--sensor", "3", "--turntable", "1") == Vector("x00.exr"))
    assert(name("--resolution", "8x8") == Vector("x%02d.exr"))

  test("of many scenes that fail, the first are named"):
    inFolder: f =>
      val words = Vector(f("no%d.pbrt"), "--frames", "1-1000", "--outfile", f("out%d.exr"))
      val (code, captured) = f.captured(words)
      val first = (1 to 20).map(n => f(s"no$n.pbrt")).mkString(", ")
      assert(code == 1)
      assert(captured.out == s"1000 scenes: 1000 failed ($first, … and 980 more)\n")

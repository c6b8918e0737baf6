package candela.cli.commands

import candela.cli.Captured
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class CheckCommandSuite extends AnyFunSuite:
  test("a scene has the name of its dialect, a model that of its format"):
    TempFolder.use: folder =>
      val obj = Files.writeString(folder.resolve("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
      def named(file: Path, options: String*) =
        val (code, captured) = Captured.run("check" +: options :+ file.toString*)
        assert(code == 0, captured.err)
        captured.out.linesIterator.next().stripPrefix(s"$file: ").takeWhile(_ != ',')
      assert(named(obj) == "obj")
      assert(named(obj, "--up", "z") == "obj")
      assert(named(Path.of("scenes/models/gl-shapes.gltf")) == "gltf")
      assert(named(Path.of("scenes/v3-matte-whitted.pbrt")) == "v3")
      assert(named(Path.of("scenes/mitsuba/mi-bsdfs.xml")) == "mitsuba")

package candela.cli.files

import candela.cli.{Captured, SandboxSuite}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** A Film that leaves the folder where images go is rendered, with a warning. */
class FilmNameSuite extends AnyFunSuite:
  import SandboxSuite.film

  private val here = Path.of("").toAbsolutePath

  private def inFolder(body: (Path, String => String) => Unit): Unit = TempFolder.use: folder =>
    body(folder, name => Files.writeString(folder.resolve("s.pbrt"), film(name)).toString)

  private def warning(kind: String, image: Path, scene: String): String =
    val shown = here.relativize(image.toAbsolutePath.normalize)
    s"$scene:1:30: warning: the scene names its image by $kind; from this folder, it goes to " +
      s"`$shown`"

  test("an absolute path, and one through `..`, are warnings with place, and rendered"):
    inFolder: (folder, scene) =>
      val absolute = folder.resolve("a.exr")
      val relative = s"${here.relativize(folder.toAbsolutePath)}/b.exr"
      for (name, kind) <- Vector(
          absolute.toString -> "an absolute path",
          relative -> "a path through `..`"
        )
      do
        val file = scene(name)
        val (code, captured) = Captured.run(file)
        val expected = warning(kind, Path.of(name), file)
        assert(code == 0 && captured.err.contains(expected), captured.err)
        assert(captured.err.contains(" 1 | Film \"rgb\""), captured.err)
        assert(Files.exists(Path.of(name)))

  test("`check` and `convert` warn, too; --outfile decides instead"):
    inFolder: (folder, scene) =>
      val file = scene(folder.resolve("a.exr").toString)
      val expected = warning("an absolute path", folder.resolve("a.exr"), file)
      for words <- Vector(Vector("check", file), Vector("convert", "--to", "v3", file)) do
        val (code, captured) = Captured.run(words*)
        assert(code == 0 && captured.err.contains(expected), captured.err)
      val (code, captured) = Captured.run(file, "--outfile", folder.resolve("b.exr").toString)
      assert(code == 0 && !captured.err.contains("names its image"), captured.err)
      assert(!Files.exists(folder.resolve("a.exr")))
      for words <- Vector(
          Vector("preview", file, "--outfile", folder.resolve("c.png").toString),
          Vector(file, "--shard", "0/1", "--outfile", folder.resolve("c.film").toString)
        )
      do
        val (code, captured) = Captured.run(words*)
        assert(code == 0 && !captured.err.contains("names its image"), captured.err)

  test("each frame warns of its name"):
    TempFolder.use: folder =>
      for i <- 1 to 2 do
        val name = folder.resolve(s"a$i.exr").toString
        Files.writeString(folder.resolve(s"s$i.pbrt"), film(name)): Unit
      val (code, captured) = Captured.run(folder.resolve("s%d.pbrt").toString, "--frames", "1-2")
      val told = "warning: the scene names its image by an absolute path"
      assert(code == 0 && captured.err.split(told, -1).length == 3, captured.err)

  test("a name within the folder is no warning"):
    val (code, captured) =
      TempFolder.use: folder =>
        val file = Files.writeString(folder.resolve("s.pbrt"), film("sub/o.exr"))
        Captured.run("check", file.toString)
    assert(code == 0 && !captured.err.contains("names its image"), captured.err)

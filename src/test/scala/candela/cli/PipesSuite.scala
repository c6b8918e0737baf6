package candela.cli

import candela.fuzz.{FilmValue, FilmValues}
import candela.image.{Image, ImageFiles}
import candela.testing.{Pipes, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

/** No pipe or device is opened that the user has not named as a stream: it might never end. */
class PipesSuite extends AnyFunSuite:
  private val Irregular = "it is no regular file, but a pipe or a device"

  private def withScene(body: FilmFilesSuite.Folder => Any): Any =
    TempFolder.use: folder =>
      assume(Pipes.make(folder.resolve("pipe")), "needs mkfifo")
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      body(FilmFilesSuite.Folder(folder, scene))

  private def refused(f: FilmFilesSuite.Folder)(words: String*): String =
    Pipes.unblocked(f.fail(words))

  test("a pipe is no film, and no previous copy of one"):
    withScene: f =>
      f.render("--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val _ = Files.write(Path.of(f("a.film")), Array[Byte](1, 2, 3))
      assert(Pipes.make(Path.of(f("a.film.previous"))))
      for
        words <- Vector(
          Vector("merge", f("a.film"), "--outfile", f("b.exr")),
          Vector("merge", "--partial", f("a.film"), "--outfile", f("b.exr")),
          Vector("resume", f("a.film")),
          Vector(f.scene, "--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
        )
      do
        val why = refused(f)(words*)
        assert(why.contains(s"nor its previous copy: $Irregular"), why)
      val why = refused(f)("merge", f("pipe"), "--outfile", f("b.exr"))
      assert(why == s"error: can't read `${f("pipe")}`: $Irregular\n")

  test("the scene of a film is a regular file"):
    withScene: f =>
      f.render("--spp", "1", "--checkpoint", f("a.film"), "--outfile", f("a.exr"))
      val values = FilmValues.of(Files.readAllBytes(Path.of(f("a.film"))))
      for scene <- Vector(f("pipe"), "/dev/zero") if Files.exists(Path.of(scene)) do
        // After the mark and the version
        val forged = FilmValues.bytes(values.updated(2, FilmValue.Text(scene)))
        val _ = Files.write(Path.of(f("forged.film")), forged)
        for words <- Vector(Vector("resume"), Vector("merge", "--outfile", f("b.exr"))) do
          val why = refused(f)(words :+ f("forged.film")*)
          assert(why.contains(s"`$scene`, the scene of `${f("forged.film")}`: $Irregular"), why)

  test("a pipe in a folder of images is none of them"):
    withScene: f =>
      val images = Files.createDirectory(f.folder.resolve("images"))
      ImageFiles.write(images.resolve("a.png"), Image.rgb(4, 4))
      assert(Pipes.make(images.resolve("b.png")))
      val said = Pipes.unblocked(f.run(Vector("compare", s"$images", s"$images")))
      assert(said.contains("a.png") && !said.contains("b.png"))

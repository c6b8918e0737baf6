package candela.cli.files

import candela.diagnostics.SceneError
import candela.image.OutputFormat
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class OutputFilesSuite extends AnyFunSuite:

  private def names(files: OutputFiles) = files.paths.map(_.toString)

  test("an EXR named by the scene gets a PNG beside it"):
    assert(names(OutputFiles.ofFilm("out/a.exr")) == Vector("out/a.exr", "out/a.png"))
    assert(names(OutputFiles.ofFilm("a.b.EXR")) == Vector("a.b.EXR", "a.b.png"))

  test("a PNG named by the scene is all there is"):
    assert(names(OutputFiles.ofFilm("a.png")) == Vector("a.png"))

  test("a PFM named by the scene gets a PNG beside it, other pictures none"):
    assert(names(OutputFiles.ofFilm("a.pfm")) == Vector("a.pfm", "a.png"))
    for name <- Vector("a.tga", "a.qoi", "a.jpg") do
      assert(names(OutputFiles.ofFilm(name)) == Vector(name))

  test("formats that are not written become EXR and PNG, with a warning"):
    val films = Vector("a.webp" -> "a", "a.b.hdr" -> "a.b", "a" -> "a", ".hidden" -> ".hidden")
    for (film, stem) <- films do
      val files = OutputFiles.ofFilm(film)
      assert(names(files) == Vector(s"$stem.exr", s"$stem.png"))
      val warning = s"`$film` is not ${OutputFormat.listed()}; " +
        s"writing `$stem.exr`"
      assert(files.warnings.map(_.message) == Vector(warning))

  test("what is asked for is taken as it is, each once"):
    val files = OutputFiles.requested(Vector("a.exr", "b.png", "a.exr"))
    assert(names(files) == Vector("a.exr", "b.png"))
    assert(files.warnings.isEmpty)

  private def problems(path: Path): Vector[String] =
    intercept[SceneError](
      OutputFiles.requested(Vector(path.toString)).check()
    ).problems.map(_.message)

  test("files that can be written pass the check, old or new"):
    TempFolder.use: folder =>
      val old = Files.createFile(folder.resolve("old.png"))
      OutputFiles.requested(Vector(old.toString, folder.resolve("new.exr").toString)).check()

  test("a folder that is not there is noticed before rendering"):
    TempFolder.use: folder =>
      val path = folder.resolve("none/a.exr")
      val parent = path.getParent
      assert(problems(path) == Vector(s"can't write `$path`: no such folder: `$parent`"))

  test("a format that is not written is noticed before rendering"):
    TempFolder.use: folder =>
      val path = folder.resolve("a.webp")
      assert(problems(path) == Vector(s"can't write `$path`"))

  test("a folder in the place of the image is noticed before rendering"):
    TempFolder.use: folder =>
      val path = Files.createDirectory(folder.resolve("a.exr"))
      assert(problems(path) == Vector(s"can't write `$path`: it is a folder"))

  test("all that is wrong is told at once"):
    TempFolder.use: folder =>
      val paths = Vector("a.gif", "none/b.png", "c.exr").map(folder.resolve(_).toString)
      val error = intercept[SceneError](OutputFiles.requested(paths).check())
      assert(error.problems.size == 2)

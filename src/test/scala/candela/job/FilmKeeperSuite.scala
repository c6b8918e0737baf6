package candela.job

import candela.diagnostics.{Code, SceneError}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

class FilmKeeperSuite extends AnyFunSuite:
  private def problem(path: Path) =
    intercept[SceneError](FilmKeeper.open(path, _ => fail())).problems.head

  test("a film that is missing is a missing file, with the nearest name"):
    TempFolder.use: folder =>
      val _ = Files.writeString(folder.resolve("scene.film"), "no film")
      val missing = problem(folder.resolve("scnee.film"))
      assert(missing.code == Code.NoSuchFile && missing.message.endsWith(": no such file"))
      assert(missing.help.contains("did you mean `scene.film`?"))
      assert(problem(folder.resolve("absent").resolve("x.film")).code == Code.NoSuchFile)
      assert(problem(folder.resolve("scene.film")).code == Code.DamagedFilm)

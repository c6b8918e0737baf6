package candela.job

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class MissingFormatsSuite extends AnyFunSuite:
  private def missing(name: String, installed: Vector[SceneFormat]) =
    MissingFormats.problem(Path.of(name), installed)

  test("a file whose module is not installed is an error that says how to install it"):
    val p = missing("a.fbx", Vector.empty).get
    assert(p.message == "`a.fbx` needs candela-assimp, which is not installed: it reads .fbx files")
    assert(p.help.exists(_.contains("-assimp.zip")))

  test("files of other formats, and of those that are installed, are none"):
    assert(missing("a.pbrt", Vector.empty).isEmpty)
    assert(missing("a.fbx", SceneFormat.all).isEmpty)

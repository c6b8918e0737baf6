package candela.job

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class MissingFormatsSuite extends AnyFunSuite:
  private def missing(name: String, installed: Vector[SceneFormat], isConfined: Boolean = false) =
    MissingFormats.problem(Path.of(name), installed, isConfined)

  test("a file whose module is not installed is an error that says how to install it"):
    val p = missing("a.fbx", Vector.empty).get
    assert(p.message == "`a.fbx` needs candela-assimp, which is not installed: it reads .fbx files")
    assert(p.help.exists(_.contains("-assimp.zip")))

  test("in a sandbox, its module would not help"):
    val p = missing("a.fbx", Vector.empty, isConfined = true).get
    assert(p.message == "`a.fbx` is read by Assimp, which no sandbox confines")
    assert(p.help.exists(_.contains("glTF")))

  test("files of other formats, and of those that are installed, are none"):
    assert(missing("a.pbrt", Vector.empty).isEmpty)
    assert(missing("a.fbx", SceneFormat.all).isEmpty)

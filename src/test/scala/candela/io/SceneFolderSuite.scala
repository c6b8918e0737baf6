package candela.io

import candela.diagnostics.Refusal

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class SceneFolderSuite extends AnyFunSuite:

  test("in a sandbox, a folder that does not exist is named as such"):
    val folder = SceneFolder.of(Path.of("nowhere", "scene.pbrt"), isConfined = true)
    val message = intercept[Refusal](folder.locate("a.ply", None)).problem.message
    assert(message.contains("there is no folder `nowhere`") && !message.contains("link"), message)

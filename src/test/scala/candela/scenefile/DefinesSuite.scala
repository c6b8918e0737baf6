package candela.scenefile

import candela.diagnostics.{Code, SceneError}
import candela.io.SceneFolder
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class DefinesSuite extends AnyFunSuite:
  private def read(text: String, values: (String, String)*): SceneDescription =
    val within = SceneFolder(Path.of(""))
    val defines = Defines(values.toMap)
    Parser.readableText("scene", text, within, Some(Dialect.V4), keepGoing = false, defines)

  private def camera(scene: SceneDescription, name: String): Option[Param] =
    scene.camera.flatMap(_.param(name))

  test("values stand in lists, in strings, and as arguments"):
    val text = """Rotate $angle 0 0 1
      |Camera "perspective" "float fov" $fov "string lensfile" "a\"$name.dat"
      |WorldBegin""".stripMargin
    val scene = read(text, "angle" -> "90", "fov" -> "[ 30 ]", "name" -> "ä$1")
    assert(scene.errors.isEmpty)
    assert(camera(scene, "fov").map(_.floats.toVector).contains(Vector(30f)))
    assert(camera(scene, "lensfile").map(_.strings).contains(Vector("a\"ä$1.dat")))

  test("comments and other names stay as they are"):
    val text = """# $fov "
      |Camera "perspective" "float fov" $fov # $other
      |  "string lensfile" "$other.dat"
      |WorldBegin""".stripMargin
    val scene = read(text, "fov" -> "30")
    assert(scene.errors.isEmpty)
    assert(camera(scene, "lensfile").map(_.strings).contains(Vector("$other.dat")))

  test("included files have the same values, also where the dialect is guessed by a second look"):
    TempFolder.use: folder =>
      val _ = Files.writeString(folder.resolve("in.pbrt"), "Shape \"sphere\" \"float radius\" $r\n")
      val text = "Film \"rgb\"\nWorldBegin\nMaterial \"diffuse\"\nInclude \"in.pbrt\"\n"
      val scene = Files.writeString(folder.resolve("s.pbrt"), text)
      val read =
        Parser.readable(scene, None, keepGoing = false, defines = Defines(Map("r" -> "2.5")))
      assert(read.dialect == Dialect.V4)
      val radius = read.shapes.head.shape.param("radius")
      assert(radius.map(_.floats.toVector).contains(Vector(2.5f)))

  test("a name without a value says how to give it one"):
    val problems = read("Camera \"perspective\" \"float fov\" $fov\nWorldBegin").errors
    assert(problems.exists(_.message.contains("found `$fov`, which has no value (-Dfov=VALUE")))

  test("a value of a name that the scene lacks is an error, with the nearest name"):
    val e = intercept[SceneError](read("WorldBegin # $fob\nScale $fov 1 1", "fow" -> "2"))
    assert(e.problems.map(_.code) == Vector(Code.SceneParameter))
    assert(e.problems.head.help.exists(_.contains("fov")), e.problems.head.help)

  test("strings of a megabyte are searched"):
    val long = "x" * (1 << 19) + "\\n" * 1000
    val text =
      s"Camera \"perspective\" \"string lensfile\" \"$long\" \"float fov\" $$fov WorldBegin"
    assert(camera(read(text, "fov" -> "3"), "fov").nonEmpty)

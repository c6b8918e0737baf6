package candela.scenefile

import candela.diagnostics.SceneError
import java.nio.file.{Files, Path}

import candela.math.Transform
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class IncludeSuite extends AnyFunSuite:

  private def withFolder[A](files: (String, String)*)(use: Path => A): A =
    val folder = Files.createTempDirectory("scene")
    try
      for (name, text) <- files do
        Files.createDirectories(folder.resolve(name).getParent)
        Files.writeString(folder.resolve(name), text)
      use(folder)
    finally
      val all = Files.walk(folder)
      try all.sorted(java.util.Comparator.reverseOrder()).forEach(Files.delete(_))
      finally all.close()

  test("included files are found from the scene's folder first, then from the including file's"):
    withFolder(
      "main.pbrt" -> "WorldBegin\n  Include \"parts/a.pbrt\"\nWorldEnd",
      "parts/a.pbrt" -> "Include \"b.pbrt\" Include \"parts/c.pbrt\"",
      "parts/b.pbrt" -> "Shape \"wrong\"",
      "b.pbrt" -> "\nShape \"b\"",
      "parts/c.pbrt" -> "Include \"d.pbrt\"",
      "parts/d.pbrt" -> "Shape \"d\" \"string filename\" \"e.ply\""
    ): folder =>
      val scene = Parser.parse(folder.resolve("main.pbrt"))
      assert(scene.shapes.map(_.shape.name) == Vector("b", "d"))
      assert(scene.shapes.forall(_.shape.folder.path == folder))
      val at = scene.shapes.head.shape.pos
      assert(at.file.endsWith("b.pbrt") && at.line == 2 && at.column == 7)
      assert(at.includedFrom.get.file.endsWith("a.pbrt"))
      assert(at.includedFrom.get.includedFrom.get.toString.endsWith("main.pbrt:2:3"))

  test("pipes and devices are not included: they might never end"):
    val why = intercept[SceneError]:
      Parser.parseText("test", "WorldBegin Include \"/dev/zero\"", Path.of(""))
    assert(why.problems.head.message ==
      "can't include `/dev/zero`: it is a pipe or a device, not a regular file")

  test("files that include the next one twice are read a limited number of times", Slow):
    val files = (0 to 30).map(i => s"$i.pbrt" -> s"Include \"${i + 1}.pbrt\" " * 2)
    withFolder((files :+ ("31.pbrt" -> "# end"))*): folder =>
      val why = intercept[SceneError]:
        Parser.parseText("test", "WorldBegin Include \"0.pbrt\" WorldEnd", folder)
      assert(why.problems.exists(_.message == "more than 100000 files are included"))

  test("so are those that go on with the parameters before the Include", Slow):
    val part = "\"float a\" 1" + " Shape \"s\" Include \"NEXT.pbrt\"" * 2
    val files = (0 to 30).map(i => s"$i.pbrt" -> part.replace("NEXT", s"${i + 1}"))
    withFolder((files :+ ("31.pbrt" -> "\"float a\" 1"))*): folder =>
      val why = intercept[SceneError]:
        Parser.parseText("test", "WorldBegin Shape \"s\" Include \"0.pbrt\" WorldEnd", folder)
      assert(why.problems.exists(_.message == "more than 100000 files are included"))

  test("a scene consists of every file whose parameters a list has"):
    withFolder("a.pbrt" -> "\"float a\" 1", "b.pbrt" -> "\"float b\" 2"): folder =>
      val text = "WorldBegin Shape \"s\" Include \"a.pbrt\" Include \"b.pbrt\" Include \"a.pbrt\""
      val scene = Parser.parseText("test", text, folder, keepGoing = true)
      assert(scene.sources == Vector("a.pbrt", "b.pbrt").map(folder.resolve))

  test("a string that is not closed in a file of parameters is an error there, once"):
    withFolder("a.pbrt" -> "\"float a"): folder =>
      val text = "WorldBegin Shape \"s\" Include \"a.pbrt\" WorldEnd"
      val problems = intercept[SceneError](Parser.parseText("test", text, folder)).problems
      assert(problems.map(_.message) == Vector("string not closed at the end of the file"))
      assert(problems.head.pos.exists(at => at.file.endsWith("a.pbrt") && at.column == 1))

  test("an included file shares the graphics state; an imported one gives its back"):
    withFolder("a.pbrt" -> "Translate 1 0 0 Shape \"in\""): folder =>
      def start(directive: String) =
        val text = s"WorldBegin $directive \"a.pbrt\" Shape \"out\""
        Parser.parseText("test", text, folder).shapes.map(_.objectToWorld.start)
      assert(start("Include") == Vector.fill(2)(Transform.translate(1, 0, 0)))
      assert(start("Import") == Vector(Transform.translate(1, 0, 0), Transform.Identity))

  test("the last statement of an included file goes on where that was included"):
    withFolder(
      "a.pbrt" -> "Include \"b.pbrt\" \"float c\" 3",
      "b.pbrt" -> "Shape \"first\" Shape \"last\" \"float a\" 1"
    ): folder =>
      val text = "WorldBegin Include \"a.pbrt\" \"float d\" 4 Shape \"next\" \"float e\" 5"
      val shapes = Parser.parseText("test", text, folder).shapes.map(_.shape)
      assert(shapes.map(_.name) == Vector("first", "last", "next"))
      assert(shapes.map(_.params.map(_.name).mkString) == Vector("", "acd", "e"))
      val missing = text.replace("a.pbrt", "no.pbrt")
      val kept = Parser.parseText("test", missing, folder, None, keepGoing = true)
      assert(kept.shapes.map(_.shape.name) == Vector("next") && kept.warnings.size == 1)

  test("a parameter list may go on in included files, and the statement ends there"):
    withFolder(
      "a.pbrt" -> "\"float a\" 1",
      "b.pbrt" -> "# more\n\"float b\" 2 Shape \"next\"",
      "other.pbrt" -> "Shape \"other\""
    ): folder =>
      val list = "Include \"a.pbrt\" \"float c\" 3 Include \"b.pbrt\" \"float d\" 4"
      val text = s"WorldBegin Shape \"first\" $list Include \"other.pbrt\""
      val scene = Parser.parseText("test", text, folder)
      assert(scene.shapes.map(_.shape.name) == Vector("first", "next", "other"))
      assert(scene.shapes.map(_.shape.params.map(_.name).mkString) == Vector("acb", "d", ""))
      assert(scene.warnings.isEmpty && scene.errors.isEmpty)
      val at = scene.shapes(1).shape.pos
      assert(at.file.endsWith("b.pbrt") && at.includedFrom.exists(_.column == 55), at)

  test("files that include one another are an error that names them"):
    withFolder(
      "main.pbrt" -> "WorldBegin Include \"a.pbrt\"",
      "a.pbrt" -> "Include \"b.pbrt\"",
      "b.pbrt" -> "Include \"a.pbrt\""
    ): folder =>
      val error = intercept[SceneError](Parser.parse(folder.resolve("main.pbrt"))).problems.head
      assert(error.message.startsWith("`a.pbrt` includes itself, through `"))
      assert(error.message.endsWith("b.pbrt`"))
      assert(error.pos.get.file.endsWith("b.pbrt"))

  test("a scene file that is not there, or is a folder, is an error without a place"):
    for path <- List("no/such.pbrt", "src") do
      val problem = intercept[SceneError](Parser.parse(Path.of(path))).problems.head
      assert(
        problem.pos.isEmpty && problem.message.startsWith(s"can't read the scene file `$path`")
      )

  test("a name that no file can have is a file that is not there"):
    val error = intercept[SceneError]:
      Parser.parseText("test", "WorldBegin Include \"\u0000\"", Path.of("."))
    assert(error.problems.head.message.endsWith("no such file"))

package candela.scenefile

import candela.diagnostics.SceneError
import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class ParserErrorsSuite extends AnyFunSuite:

  private def parse(text: String): SceneDescription =
    Parser.parseText("test.pbrt", text, Path.of("folder"))

  private def errors(text: String): Vector[String] =
    intercept[SceneError](parse(text)).problems.map(_.message)

  test("each independent error is reported, up to 1000"):
    val text = "WorldBegin Tranlate 1 1 1\nShape 3\nRotate 1 2\nShape \"a\" \"flot x\" 1\nWorldEnd"
    assert(errors(text).size == 4)
    val many = errors("WorldBegin" + " Shape 3" * 1100)
    assert(many.size == 1001 && many.last == "parsing stopped after 1000 errors")

  test("what follows a mistake in a list, or in its number of values, is still checked"):
    for
      statement <- Vector(
        "Material \"diffuse\" \"rgb reflectance\" [1 1]",
        "Shape \"a\" \"point3 P\" [ 1 2 ]",
        "Shape \"a\" \"texture t\" [ \"a\" \"b\" ]",
        "Shape \"a\" \"float x\"",
        "Shape \"a\" \"float x\" [ 1",
        "Shape \"a\" \"flot x\" 1",
        "Texture \"a\" \"color\"",
        "Translate 1 2",
        "Scal 1 2",
        "MakeNamedMaterial \"a\" \"float x\" 1",
        "Tranlate"
      )
    do
      val both =
        errors(s"WorldBegin\n$statement\n  AttributBegin # begins\nShape \"a\"\nAttributeEnd")
      assert(both.size == 2 && both(1).contains("`AttributBegin`"), s"$statement: $both")

  test("a misspelt argument is told once"):
    for statement <- Vector("Translate 1 2 X", "Camera Perspective", "Shape \"a\" \"float x\" X") do
      assert(errors(s"WorldBegin\n$statement\n").size == 1, statement)

  test("a transform of a number that no Float holds is an error"):
    val rows = Seq.fill(15)("0").mkString(" ")
    for text <- Seq("Translate 1e400 0 0", "Scale 1e300 1 1", s"Transform [ -1e400 $rows ]") do
      assert(errors(text).exists(_.contains("numbers; number 1 is ")), text)

  test("a typing error in a Begin makes no second error of its End"):
    assert(errors("WorldBegin\nAttributBegin\nShape \"a\"\nAttributeEnd\nWorldEnd").size == 1)

  test("whatever is cut out of a scene, or put into it, gives a scene or a SceneError"):
    val text = """LookAt 0 0 5  0 0 0  0 1 0 # é
                 |Camera "perspective" "float fov" [ 45 ] "bool b" true
                 |WorldBegin AttributeBegin Texture "t" "float" "scale" "texture tex1" "u"
                 |Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ] Shape "a" "integer i" [ 1 2 3 ]
                 |AttributeEnd ObjectBegin "o" ObjectEnd WorldEnd""".stripMargin
    val characters = Vector("\"", "[", "]", "#", "\\", "\n", " ", "-", "\u0000", "é")
    val pieces = characters ++ Vector("1e", "Shape ", "\"a\"")
    val random = scala.util.Random(1)
    for _ <- 0 until 5000 do
      val from = random.nextInt(text.length)
      val until = (from + random.nextInt(8)).min(text.length)
      val broken = text.patch(from, pieces(random.nextInt(pieces.size)), until - from)
      try assert(parse(broken).camera.forall(_.name != "no such name"))
      catch case e: SceneError => assert(e.problems.nonEmpty)

package candela.cli.terminal

import candela.diagnostics.SceneError
import java.nio.file.{Files, Path}
import scala.jdk.StreamConverters.*

import candela.scenefile.Parser
import org.scalatest.funsuite.AnyFunSuite

/** Whole messages: `errors/NAME.pbrt` must give exactly `errors/NAME.txt`, errors or warnings. */
class ErrorMessagesSuite extends AnyFunSuite:

  private val folder = Path.of("src/test/resources/errors")

  private def messages(scene: Path): String =
    val problems =
      try Parser.parse(scene).warnings
      catch
        case e: SceneError => e.problems
    // file names as they are where `/` stands between folders
    val separator = java.io.File.separator
    problems
      .map(ProblemText.format(_))
      .mkString("", "\n\n", "\n")
      .replace(s"$folder$separator", "errors/")
      .replace(s"errors/parts$separator", "errors/parts/")
      .replace(s"`$folder`", "`errors`")

  private val scenes =
    val all = Files.list(folder)
    try all.toScala(Vector).filter(_.toString.endsWith(".pbrt")).sorted
    finally all.close()

  test("there are at least 20 scenes with errors"):
    assert(scenes.size >= 20)

  for scene <- scenes do
    val name = scene.getFileName.toString.stripSuffix(".pbrt")
    test(s"$name.pbrt gives the message of $name.txt"):
      val expected = folder.resolve(s"$name.txt")
      assert(Files.exists(expected), s"no such file; the message is\n${messages(scene)}")
      assert(messages(scene) == Files.readString(expected).replace("\r\n", "\n"))

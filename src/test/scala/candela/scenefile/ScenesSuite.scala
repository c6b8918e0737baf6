package candela.scenefile

import java.nio.file.{Files, Path}
import scala.jdk.StreamConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** Every scene of the project's own `scenes` folder is read without a problem. */
class ScenesSuite extends AnyFunSuite:

  private val folder = Path.of("scenes")

  private val scenes =
    if !Files.isDirectory(folder) then Vector.empty
    else
      val all = Files.list(folder)
      try all.toScala(Vector).filter(_.toString.matches(".*\\.pbrt(\\.gz)?")).sorted
      finally all.close()

  for scene <- scenes do
    test(s"$scene is read without errors and warnings"):
      val description = Parser.parse(scene)
      assert(description.warnings.isEmpty)
      assert(description.shapes.nonEmpty || description.instances.nonEmpty)

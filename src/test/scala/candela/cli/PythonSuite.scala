package candela.cli

import candela.mitsuba.Plugins
import candela.testing.{ClassPathProgram, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** The Python module. */
class PythonSuite extends AnyFunSuite:
  private val module = Path.of("packaging", "python")

  test("the module knows the types that the reader of Mitsuba's XML knows, by their elements"):
    val source = Files.readString(module.resolve("candela/_plugins.py"))
    val table = raw"""(?s)"(\w+)":\s*"{1,3}([^"]+)"{1,3},""".r.findAllMatchIn(source)
    val written = table.map(m => m.group(1) -> m.group(2).trim.split(raw"\s+").toSet).toMap
    val read = (Plugins.read.toVector ++ Plugins.unsupportedTypes)
      .groupMapReduce(_._1)(_._2.toSet)(_ ++ _)
    // A spectrum is one of the textures
    val textures = written("texture") ++ written("spectrum")
    assert(written - "spectrum" + ("texture" -> textures) == read)

  test("the module's tests pass", org.scalatest.tagobjects.Slow):
    if Try(ProcessBuilder("python3", "-c", "import numpy").start().waitFor()).toOption != Some(0)
    then cancel("python3 with numpy is not installed")
    TempFolder.use: folder =>
      val program = ClassPathProgram.in(folder)
      val builder = ProcessBuilder("python3", "packaging/test_candela.py").redirectErrorStream(true)
      builder.environment.putAll(Map(
        "CANDELA_PROGRAM" -> s"$program",
        "PYTHONPATH" -> s"$module",
        "PYTHONDONTWRITEBYTECODE" -> "1"
      ).asJava)
      val process = builder.start()
      process.getOutputStream.close()
      val printed = String(process.getInputStream.readAllBytes())
      assert(process.waitFor() == 0, printed)
